#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "core/bulk_list.hpp"
#include "core/item_loop.hpp"
#include "core/pslg.hpp"
#include "core/tri_mesh.hpp"
#include "gis/crs/crs.hpp"
#include "gis/projection/projection.hpp"

namespace coastmesh {

// River: inflow given by a discharge; Open: by a water level.
enum class BoundaryRole { Land, Island, Open, River };
inline constexpr std::array kBoundaryRoles{BoundaryRole::Land, BoundaryRole::Island, BoundaryRole::Open,
                                           BoundaryRole::River};
std::string_view toString(BoundaryRole role);

// A chain of nodes on the mesh's boundary, with the mesh to its left; closed loops do not repeat their first node.
// Where one chain ends and another begins, both have the node.
struct Boundary {
  BoundaryRole role = BoundaryRole::Land;
  bool closed = true;
  std::vector<std::uint32_t> nodes;
  int ibtype = -1;                          // ADCIRC's type if given by a file or the user, else -1: the role's default
  std::vector<std::uint32_t> back_nodes{};  // of a weir between two shores: for each node the one across
  bool repeats_first = false;               // a file's segment repeated its first node at its end
  std::vector<double> weir{};               // of a weir: heights and coefficients, the same number for each node
  std::string name{};                       // of the river or opening; empty: none
};

// A line inside the mesh, given by the user: a chain of nodes along edges, with the mesh on both sides; a closed one
// does not repeat its first node.
enum class LineKind { Constraint, Weir, RegionBorder };
struct GridLine {
  LineKind kind = LineKind::Constraint;
  std::string name;
  bool closed = false;
  std::vector<std::uint32_t> nodes;
};

// The origin of a triangle.
struct GridFeature {
  std::int64_t fid = 0;
  std::string source;
  std::vector<std::pair<std::string, std::string>> attributes;
  std::string region{};  // empty: none
};

// Values of a model at nodes besides depths, such as friction: a nodal attribute (names are in gis/fields).
struct NodeField {
  std::string name;             // as ADCIRC spells it, if it knows it: "mannings_n_at_sea_floor"
  std::string unit{};           // empty: none is known
  std::uint32_t component = 0;  // of several values for each node, from 1; they follow one another. 0: the only one
  double usual = std::numeric_limits<double>::quiet_NaN();  // of nodes of which nothing else is known; NaN: none
  std::vector<double> values{};                             // one for each node; NaN if unknown
};

// A mesh as models and GIS see it: what writers write and readers read.
struct Grid {
  std::string title;
  Crs crs;
  BulkList<Point> nodes;                             // in `crs`; those of `makeGrid` all belong to a triangle
  std::vector<double> z;                             // metres, positive up; empty or one per node, NaN if unknown
  std::vector<double> size_m;                        // empty or one for each node: the requested edge length there
  std::vector<NodeField> node_fields;                // each name and component once
  BulkList<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise
  // Empty or one for each triangle: two triangles with the same number that share an edge are the halves of a
  // quadrilateral of a file (gis/elements); kNone, or no other half: a triangle.
  std::vector<std::uint32_t> quad_of;
  BulkList<std::uint32_t> feature_of;       // empty or one for each triangle: index into `features`
  std::vector<std::uint32_t> piece_of;      // empty or one per triangle: the piece that it was refined in
  std::vector<std::uint32_t> part_of;       // empty or one for each triangle: the solver's process, from 0
  std::vector<std::uint32_t> node_part_of;  // empty or one for each node, in the same way
  BulkList<double> min_angle_deg;           // empty or one per triangle, as measured when meshed
  BulkList<double> area_m2;                 // empty or one for each triangle, on the ellipsoid
  std::vector<GridFeature> features;
  std::vector<Boundary> boundaries;
  std::vector<GridLine> lines;
  std::vector<std::string> notes;  // inconsistencies in the file: "NETA is 12, but 11 nodes follow"
};

// The arrays with one entry for each node, and for each triangle: edits of a grid use these. Each names every member of
// Grid, so that a new member does not compile until it is added where it belongs. Those of `node_fields` come on top of
// the former: `forEachNodeArray` visits all.
template <typename AnyGrid>
auto nodeArrays(AnyGrid& grid) {
  auto& [title, crs, nodes, z, size_m, node_fields, triangles, quad_of, feature_of, piece_of, part_of, node_part_of,
         min_angle_deg, area_m2, features, boundaries, lines, notes] = grid;
  return std::tie(nodes, z, size_m, node_part_of);
}
template <typename AnyGrid>
auto triangleArrays(AnyGrid& grid) {
  auto& [title, crs, nodes, z, size_m, node_fields, triangles, quad_of, feature_of, piece_of, part_of, node_part_of,
         min_angle_deg, area_m2, features, boundaries, lines, notes] = grid;
  return std::tie(triangles, quad_of, feature_of, piece_of, part_of, min_angle_deg, area_m2);
}

template <typename AnyGrid, typename Use>
void forEachNodeArray(AnyGrid& grid, const Use& use) {
  std::apply([&use](auto&... array) { (use(array), ...); }, nodeArrays(grid));
  for (auto& field : grid.node_fields) use(field.values);
}

// Throws OutputError if a z is unknown; for formats that need one at every node.
void requireZ(const Grid& grid, const std::string& path);

// The grid as a mesh in the plane of `projection` (for checks, figures and plots).
TriMesh toTriMesh(const Grid& grid, const Projection& projection, std::vector<EdgeConflict>& conflicts,
                  const ItemLoop& loop = inOrder);

}  // namespace coastmesh
