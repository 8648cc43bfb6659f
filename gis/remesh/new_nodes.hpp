#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/item_loop.hpp"
#include "core/tri_mesh.hpp"
#include "gis/grid/grid.hpp"
#include "gis/remesh/remesh_patch.hpp"

namespace coastmesh {

// An edge of a grid that vertices of a patch's new mesh divide.
struct DividedEdge {
  std::array<std::uint32_t, 2> ends;  // nodes of the grid
  std::vector<VertexId> added;        // vertices of the mesh, from the first end to the second
};

// The vertices of a patch's new mesh that are not those of its graph, in order: vertex `domain.pslg.points.size() + i`
// is the i-th.
struct NewNodes {
  std::vector<Point> places;                // in the grid's CRS
  std::vector<double> z;                    // empty if the grid has none
  std::vector<std::vector<double>> fields;  // of each field of the grid
  std::vector<DividedEdge> divided;
};

// Depths and fields are linear over the triangles that are replaced, and along divided edges; unknown (NaN) where a
// corner's is. Longitudes are in the range of the grid's. `mesh` is of the patch's graph.
NewNodes newNodesOf(const Grid& grid, const RemeshPatch& patch, const TriMesh& mesh, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
