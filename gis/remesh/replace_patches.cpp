#include "gis/remesh/replace_patches.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "core/quality.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/remesh/new_nodes.hpp"

namespace coastmesh {

namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// Where the items that stay and the new ones are in a list.
struct Slots {
  std::vector<std::uint32_t> sources;  // for each place: the old item, kNone for a new one
  std::vector<std::uint32_t> of_old;   // the place of each old item, kNone if it is gone
  std::vector<std::uint32_t> of_new;

  Slots(const std::vector<std::uint8_t>& gone, std::size_t added) : of_old(gone.size(), kNone), of_new(added) {
    sources.reserve(gone.size() + added);
    std::size_t next = 0;
    const auto addNew = [&] {
      of_new[next++] = static_cast<std::uint32_t>(sources.size());
      sources.push_back(kNone);
    };
    for (std::uint32_t i = 0; i < gone.size(); ++i) {
      if (gone[i] == 0) {
        of_old[i] = static_cast<std::uint32_t>(sources.size());
        sources.push_back(i);
      } else if (next < added) {
        addNew();
      }
    }
    while (next < added) addNew();
  }

  // Brings the values of an array, which may be empty, into these places. `valueOf(i)` is that of new item i.
  template <typename List, typename ValueOf>
  void place(List& values, const ItemLoop& loop, const ValueOf& valueOf) const {
    if (values.empty()) return;
    List placed;
    placed.resize(sources.size());
    forEachByStretches(loop, of_old.size(), [&](std::size_t i) {
      if (of_old[i] != kNone) placed[of_old[i]] = values[i];
    });
    forEachByStretches(loop, of_new.size(), [&](std::size_t i) { placed[of_new[i]] = valueOf(i); });
    values = std::move(placed);
  }
};

// The new items of all patches, one after another.
struct NewItems {
  std::vector<Point> places;
  std::vector<double> z, size_m;
  std::vector<std::vector<double>> fields;            // of each field of the grid
  std::vector<std::array<std::uint32_t, 3>> corners;  // in the new numbers
  std::vector<std::uint32_t> features;
  std::vector<double> min_angle_deg;
};

// The nodes that divide edges, in the new numbers, from the lesser of an edge's old ends to the greater.
class Divisions {
 public:
  void add(const DividedEdge& edge, std::vector<std::uint32_t> nodes) {
    const auto [a, b] = edge.ends;
    if (a > b) std::ranges::reverse(nodes);
    of_[edgeKey(a, b)] = std::move(nodes);
  }

  // Appends the nodes between two old ones.
  void append(std::uint32_t a, std::uint32_t b, std::vector<std::uint32_t>& nodes) const {
    const auto found = of_.find(edgeKey(a, b));
    if (found == of_.end()) return;
    const std::vector<std::uint32_t>& between = found->second;
    if (a < b)
      nodes.insert(nodes.end(), between.begin(), between.end());
    else
      nodes.insert(nodes.end(), between.rbegin(), between.rend());
  }

 private:
  std::map<NodePair, std::vector<std::uint32_t>> of_;
};

// A chain in the new numbers, with the nodes that divide its edges; `added` counts these.
std::vector<std::uint32_t> ledThrough(const std::vector<std::uint32_t>& chain, bool closed, const Slots& slots,
                                      const Divisions& divisions, std::size_t& added) {
  std::vector<std::uint32_t> nodes;
  nodes.reserve(chain.size());
  for (std::size_t i = 0; i < chain.size(); ++i) {
    nodes.push_back(slots.of_old[chain[i]]);
    if (i + 1 < chain.size()) divisions.append(chain[i], chain[i + 1], nodes);
  }
  if (closed && chain.size() > 1) divisions.append(chain.back(), chain.front(), nodes);
  added += nodes.size() - chain.size();
  return nodes;
}

// The nodes that no triangle has after the patches are gone, and had before, and that no patch keeps.
std::vector<std::uint8_t> goneNodes(const Grid& grid, const std::vector<RemeshPatch>& patches,
                                    const std::vector<std::uint8_t>& gone_triangles) {
  std::vector<std::uint8_t> gone(grid.nodes.size(), 0);
  for (const RemeshPatch& patch : patches)
    for (const std::uint32_t t : patch.triangles)
      for (const std::uint32_t node : grid.triangles[t]) gone[node] = 1;
  for (const RemeshPatch& patch : patches)
    for (const std::uint32_t node : patch.nodes) gone[node] = 0;
  for (std::size_t t = 0; t < gone_triangles.size(); ++t)
    if (gone_triangles[t] == 0)
      for (const std::uint32_t node : grid.triangles[t]) gone[node] = 0;
  return gone;
}

// Angles as the mesh was made: in the plane, or in space.
void addAngles(const Domain& domain, const TriMesh& mesh, const ItemLoop& loop, std::vector<double>& min_angle_deg) {
  const std::size_t before = min_angle_deg.size();
  min_angle_deg.resize(before + mesh.triangles.size());
  const GroundPlaces ground = domain.projection.groundPlaces(mesh.points, loop);
  forEachByStretches(loop, mesh.triangles.size(), [&](std::size_t t) {
    const auto [a, b, c] = mesh.triangles[t].v;
    min_angle_deg[before + t] = ground.empty() ? leastAngleDeg(mesh.points[a], mesh.points[b], mesh.points[c])
                                               : leastSpaceAngleDeg(ground.space[a], ground.space[b], ground.space[c]);
  });
}

}  // namespace

ReplaceReport replacePatches(Grid& grid, const std::vector<RemeshPatch>& patches, std::vector<PatchMesh>&& meshes,
                             const ItemLoop& loop) {
  ReplaceReport report;
  report.nodes_before = grid.nodes.size();
  report.triangles_before = grid.triangles.size();
  std::vector<std::uint8_t> gone_triangles(grid.triangles.size(), 0);
  for (const RemeshPatch& patch : patches)
    for (const std::uint32_t t : patch.triangles) gone_triangles[t] = 1;
  const std::vector<std::uint8_t> gone_nodes = goneNodes(grid, patches, gone_triangles);

  std::vector<NewNodes> of_patch;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    of_patch.push_back(newNodesOf(grid, patches[p], meshes[p].mesh, loop));
    report.nodes_added += of_patch.back().places.size();
    report.triangles_added += meshes[p].mesh.triangles.size();
  }
  const Slots nodes(gone_nodes, report.nodes_added), triangles(gone_triangles, report.triangles_added);

  NewItems items;
  items.fields.resize(grid.node_fields.size());
  Divisions divisions;
  std::size_t first_node = 0;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    const std::size_t kept = patches[p].nodes.size(), added = of_patch[p].places.size();
    const auto nodeOf = [&](VertexId v) {
      return v < kept ? nodes.of_old[patches[p].nodes[v]] : nodes.of_new[first_node + v - kept];
    };
    const TriMesh& mesh = meshes[p].mesh;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const auto [a, b, c] = mesh.triangles[t].v;
      items.corners.push_back({nodeOf(a), nodeOf(b), nodeOf(c)});
      items.features.push_back(static_cast<std::uint32_t>(mesh.regions[t]));
    }
    for (const DividedEdge& edge : of_patch[p].divided) {
      std::vector<std::uint32_t> between;
      for (const VertexId v : edge.added) between.push_back(nodeOf(v));
      divisions.add(edge, std::move(between));
    }
    items.places.insert(items.places.end(), of_patch[p].places.begin(), of_patch[p].places.end());
    items.z.insert(items.z.end(), of_patch[p].z.begin(), of_patch[p].z.end());
    for (std::size_t k = 0; k < items.fields.size(); ++k)
      items.fields[k].insert(items.fields[k].end(), of_patch[p].fields[k].begin(), of_patch[p].fields[k].end());
    for (std::size_t i = 0; i < added; ++i)
      items.size_m.push_back(meshes[p].size_m.empty() ? kUnknown : meshes[p].size_m[kept + i]);
    addAngles(patches[p].domain, mesh, loop, items.min_angle_deg);
    first_node += added;
    meshes[p] = {};
  }

  // Every member of Grid: see `nodeArrays`.
  auto& [title, crs, places, z, size_m, node_fields, corners, quad_of, feature_of, piece_of, part_of, node_part_of,
         min_angle_deg, area_m2, features, boundaries, lines, notes] = grid;
  report.partition_dropped = !part_of.empty() || !node_part_of.empty();
  part_of.clear();
  node_part_of.clear();
  notes.clear();
  for (Boundary& boundary : boundaries) {
    boundary.nodes = ledThrough(boundary.nodes, boundary.closed, nodes, divisions, report.boundary_nodes);
    std::size_t none = 0;  // edges across weirs are whole
    boundary.back_nodes = ledThrough(boundary.back_nodes, boundary.closed, nodes, divisions, none);
  }
  for (GridLine& line : lines) line.nodes = ledThrough(line.nodes, line.closed, nodes, divisions, report.line_nodes);
  for (auto& triangle : corners)
    for (std::uint32_t& node : triangle) node = nodes.of_old[node];  // of triangles that are gone: perhaps kNone
  triangles.place(corners, loop, [&](std::size_t i) { return items.corners[i]; });
  triangles.place(quad_of, loop, [](std::size_t) { return kNone; });
  triangles.place(feature_of, loop, [&](std::size_t i) { return items.features[i]; });
  const std::uint32_t piece = piece_of.empty() ? 0 : *std::ranges::max_element(piece_of) + 1;
  triangles.place(piece_of, loop, [&](std::size_t) { return piece; });
  triangles.place(min_angle_deg, loop, [&](std::size_t i) { return items.min_angle_deg[i]; });
  nodes.place(places, loop, [&](std::size_t i) { return items.places[i]; });
  nodes.place(z, loop, [&](std::size_t i) { return items.z[i]; });
  nodes.place(size_m, loop, [&](std::size_t i) { return items.size_m[i]; });
  for (std::size_t k = 0; k < node_fields.size(); ++k)
    nodes.place(node_fields[k].values, loop, [&](std::size_t i) { return items.fields[k][i]; });
  if (!area_m2.empty()) {
    const std::vector<double> areas = areasOfFew(places, items.corners, crs);
    triangles.place(area_m2, loop, [&](std::size_t i) { return areas[i]; });
  }
  report.nodes_removed = static_cast<std::size_t>(std::ranges::count(gone_nodes, 1));
  report.triangles_removed = static_cast<std::size_t>(std::ranges::count(gone_triangles, 1));
  report.nodes = nodes.sources;
  report.triangles = triangles.sources;
  return report;
}

}  // namespace coastmesh
