#pragma once

#include <tuple>
#include <type_traits>

#include "apps/job/mesh_job_result.hpp"
#include "gis/error.hpp"
#include "gis/grid/grid.hpp"
#include "parallel/bytes.hpp"

namespace coastmesh {

// Meshes as bytes, for one version of coastmesh on one kind of machine, read back bit for bit.

// Each names every member, so that a new one does not compile until it is added here.
auto partsOf(auto& crs) requires std::is_same_v<std::remove_cvref_t<decltype(crs)>, Crs> {
  auto& [wkt, authority, geographic, semi_major_m, flattening] = crs;
  return std::tie(wkt, authority, geographic, semi_major_m, flattening);
}
auto partsOf(auto& boundary) requires std::is_same_v<std::remove_cvref_t<decltype(boundary)>, Boundary> {
  auto& [role, closed, nodes, ibtype, back_nodes, repeats_first, weir, name] = boundary;
  return std::tie(role, closed, nodes, ibtype, back_nodes, repeats_first, weir, name);
}
auto partsOf(auto& line) requires std::is_same_v<std::remove_cvref_t<decltype(line)>, GridLine> {
  auto& [kind, name, closed, nodes] = line;
  return std::tie(kind, name, closed, nodes);
}
auto partsOf(auto& field) requires std::is_same_v<std::remove_cvref_t<decltype(field)>, NodeField> {
  auto& [name, unit, component, usual, values] = field;
  return std::tie(name, unit, component, usual, values);
}
auto partsOf(auto& feature) requires std::is_same_v<std::remove_cvref_t<decltype(feature)>, GridFeature> {
  auto& [fid, source, attributes, region] = feature;
  return std::tie(fid, source, attributes, region);
}
auto partsOf(auto& grid) requires std::is_same_v<std::remove_cvref_t<decltype(grid)>, Grid> {
  auto& [title, crs, nodes, z, size_m, node_fields, triangles, quad_of, feature_of, piece_of, part_of, node_part_of,
         min_angle_deg, area_m2, features, boundaries, lines, notes] = grid;
  return std::tie(title, crs, nodes, z, size_m, node_fields, triangles, quad_of, feature_of, piece_of, part_of,
                  node_part_of, min_angle_deg, area_m2, features, boundaries, lines, notes);
}
auto partsOf(auto& refusal) requires std::is_same_v<std::remove_cvref_t<decltype(refusal)>, Refusal> {
  auto& [source, fids, reason, place, over_budget, lacks_memory] = refusal;
  return std::tie(source, fids, reason, place, over_budget, lacks_memory);
}
auto partsOf(auto& edit) requires std::is_same_v<std::remove_cvref_t<decltype(edit)>, Edit> {
  auto& [kind, place, fid, feature] = edit;
  return std::tie(kind, place, fid, feature);
}
auto partsOf(auto& shortfall) requires std::is_same_v<std::remove_cvref_t<decltype(shortfall)>, Shortfall> {
  auto& [count, places] = shortfall;
  return std::tie(count, places);
}

template <>
struct HasNoGaps<BoundViolationPlace> : std::true_type {};
template <>
struct HasNoGaps<MeshQuality> : std::true_type {};

using ByteReader = BasicByteReader<InputError>;

}  // namespace coastmesh
