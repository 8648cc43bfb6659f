#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/item_loop.hpp"
#include "core/tri_mesh.hpp"
#include "gis/grid/grid.hpp"
#include "gis/remesh/remesh_patch.hpp"

namespace coastmesh {

// The new mesh of a patch.
struct PatchMesh {
  TriMesh mesh;                // of the graph of the patch's domain, whose segments that nothing divides are its edges
  std::vector<double> size_m;  // the requested length at each vertex
};

struct ReplaceReport {
  // Of each node and triangle its number in the grid before, from 0; kNone for new ones.
  std::vector<std::uint32_t> nodes, triangles;
  std::size_t nodes_before = 0, triangles_before = 0;
  std::size_t nodes_removed = 0, nodes_added = 0;
  std::size_t triangles_removed = 0, triangles_added = 0;
  std::size_t boundary_nodes = 0;  // of those added: on boundaries
  std::size_t line_nodes = 0;      // on lines
  bool partition_dropped = false;  // the assignment to processes, which is of the mesh before
};

// Replaces the triangles of patches. Other triangles keep their nodes, all nodes that are left keep their values bit
// for bit, and both their order. New ones take the numbers of removed ones in turn, then the following ones, so that
// all others keep their numbers too unless fewer are added than removed. Boundaries and lines are led through the nodes
// that divide their edges. REQUIRES: the patches are `patchesOf` the grid, with one mesh for each.
ReplaceReport replacePatches(Grid& grid, const std::vector<RemeshPatch>& patches, std::vector<PatchMesh>&& meshes,
                             const ItemLoop& loop = inOrder);

}  // namespace coastmesh
