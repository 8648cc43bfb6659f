#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/item_loop.hpp"
#include "core/tri_mesh.hpp"
#include "gis/grid/boundary_kinds.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// What a merged grid's boundaries follow from, besides those that it has.
struct SeamOrigin {
  std::size_t first_inserted = 0;  // boundary of the mesh that was put in; those before are of the other
  TriId first_gap = 0;             // triangle between the two
  std::vector<Boundary> weirs;     // of the other mesh, those between pairs of nodes, as they were
  std::vector<NodePair> cut;       // keys of edges of the other mesh beyond which triangles were taken out
  // The kind of an edge that was on the other mesh's boundary before; null if it was not.
  std::function<const BoundaryKind*(std::uint32_t from, std::uint32_t to)> kind_before;
  std::function<bool(const Point& a, const Point& b)> is_at_shore;  // of the other mesh, at an edge of this one
};

// Sets the boundaries of a merged grid, whose mesh is `mesh`: parts that are inside now are left out, and loops that
// have new edges are completed. Where an open boundary of the inserted mesh is joined, what is left of it is new, and
// so is one that lies along a shore of the other mesh. New edges have the kind that they had before, else that of an
// open boundary beside them, else they are land. Openings of both meshes that follow one another are one, unless the
// other mesh had two there. A weir of the inserted mesh that ends at its outline goes on to that of the other mesh if
// that is an edge away. All other boundaries keep their nodes and their order. Returns the number of edges of such
// open boundaries that became land.
std::size_t setSeamBoundaries(Grid& grid, const TriMesh& mesh, const SeamOrigin& origin, const ItemLoop& loop);

}  // namespace coastmesh
