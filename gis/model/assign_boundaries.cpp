#include "gis/model/assign_boundaries.hpp"

#include <algorithm>

#include "gis/error.hpp"
#include "gis/grid/loop_role.hpp"

namespace coastmesh {
namespace {

BoundaryEdges edgesOfLoops(const Grid& grid, const std::vector<std::vector<std::uint32_t>>& loops) {
  BoundaryEdges boundary;
  const EdgeKinds before(grid);
  for (const auto& loop : loops) {
    const bool outer = roleOfLoop(grid.nodes, loop, grid.crs) == BoundaryRole::Land;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const NodePair edge{loop[i], loop[(i + 1) % loop.size()]};
      boundary.edges.push_back(edge);
      boundary.kinds.push_back(before.forCutting(edge[0], edge[1]));
      boundary.outer.push_back(outer);
    }
    boundary.loop_ends.push_back(boundary.edges.size());
  }
  return boundary;
}

std::vector<Boundary> boundariesOf(const Grid& grid, const std::vector<std::vector<std::uint32_t>>& loops,
                                   const BoundaryEdges& boundary) {
  std::vector<std::pair<NodePair, std::size_t>> index;
  for (std::size_t e = 0; e < boundary.edges.size(); ++e) index.emplace_back(boundary.edges[e], e);
  std::ranges::sort(index);
  return cutLoops(grid, loops, [&](std::uint32_t from, std::uint32_t to) {
    const auto at =
        std::ranges::lower_bound(index, NodePair{from, to}, {}, [](const auto& entry) { return entry.first; });
    return boundary.kinds[at->second];
  });
}

}  // namespace

BoundaryReport assignBoundaries(Grid& grid, const BoundaryOptions& options, const ItemLoop& loop) {
  if (!options.any()) return {};
  const auto isWeir = [](const Boundary& boundary) { return !boundary.weir.empty(); };
  if (std::ranges::any_of(grid.boundaries, isWeir))
    throw InputError("the mesh has weirs, whose boundaries cannot be set anew; leave the options of boundaries out");
  const std::vector<std::vector<std::uint32_t>> loops = boundaryLoops(grid, loop);
  BoundaryEdges boundary = edgesOfLoops(grid, loops);
  const BoundaryPlaces at{grid.crs, grid.nodes, grid.z};
  BoundaryReport report = defineKinds(at, options, boundary);
  report.merged = mergeShort(at, options.least_length_m, boundary);
  grid.boundaries = boundariesOf(grid, loops, boundary);
  return report;
}

}  // namespace coastmesh
