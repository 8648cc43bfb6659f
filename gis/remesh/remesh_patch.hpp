#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/item_loop.hpp"
#include "core/tri_mesh.hpp"
#include "gis/clean/domain.hpp"
#include "gis/grid/grid.hpp"
#include "gis/size/size_distance.hpp"

namespace coastmesh {

// A connected part of a grid whose triangles will be replaced. In the graph of its domain
// - edges shared with triangles that stay are segments that nothing divides, and so are edges of weirs between two
//   shores or with heights, and edges of boundaries that run through the inside;
// - other edges of the grid's boundary, of its lines, and between features are segments that may be divided;
// - other nodes of boundaries and lines are points;
// - labels are the grid's indices of features, 0 if it has none.
struct RemeshPatch {
  std::vector<std::uint32_t> triangles;  // of the grid, ascending
  std::vector<std::uint32_t> nodes;      // for each point of the domain's graph: the grid's node
  Domain domain;
  // The segments that nothing divides, with the mean edge of the triangle that stays beside them, or their own length;
  // without a rate.
  std::vector<SizedLine> rim;
  std::vector<SegmentId> shared;  // the segments of edges shared with triangles that stay
};

// The parts of a grid whose triangles have a flag in `taken`; triangles are in one part if they share edges. `mesh` is
// the grid's, from `linkGrid`. Throws InputError for a part that cannot be projected, and for a clockwise or flat
// triangle at the outline of a part.
std::vector<RemeshPatch> patchesOf(const Grid& grid, const TriMesh& mesh, const std::vector<std::uint8_t>& taken,
                                   const ItemLoop& loop = inOrder);

}  // namespace coastmesh
