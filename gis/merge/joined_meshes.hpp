#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/item_loop.hpp"
#include "core/tri_mesh.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/grid.hpp"
#include "gis/merge/gap_faces.hpp"
#include "gis/merge/nest_plane.hpp"

namespace coastmesh {

// Which triangles a merged mesh has.
struct JoinedMeshes {
  TriMesh mesh;  // the grid's, nodes that both have at the places of the inserted mesh's, in the plane if there is one
  std::vector<std::uint32_t> same;  // for each node of the grid: that of the inserted mesh that it becomes, or kNone
  // The triangles of the grid that are not covered, of the inserted mesh, and of the gap between them. Nodes are
  // numbered as in `GapFaces`.
  TriMesh whole;
  std::vector<TriId> kept;  // of the grid: the first triangles of `whole`, ascending
  TriId first_inserted = 0, first_gap = 0;
  std::vector<std::uint8_t> taken;  // for each triangle of `whole`: 0 if it is left out after all
  std::size_t covered = 0;          // triangles of the grid that the inserted mesh replaces
  std::size_t cut_off = 0;          // triangles of waters that only those connected to the rest: left out
  std::size_t joined = 0;           // edges where the inserted mesh ended, with a triangle beyond now
  std::size_t joined_land = 0;      // of these, those of its land boundaries
  std::vector<NodePair> closed;     // edges of its land boundaries that are hardly a shore (`frameSides`)
  bool has_open = true;             // the inserted mesh has an open boundary
  std::vector<LineEnd> line_ends;

  bool isTaken(TriId t) const { return taken[t] != 0; }
};

// In `plane` if that is not null, else in the grids' coordinates. Throws InputError as `mergeGrids` does.
JoinedMeshes joinMeshes(const Grid& grid, const Grid& inserted, const NestPlane* plane, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
