#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "apps/remesh/remesh_grid.hpp"
#include "core/item_loop.hpp"
#include "core/run_control.hpp"
#include "gis/grid/grid.hpp"
#include "gis/merge/merge_grids.hpp"
#include "gis/model/depth.hpp"
#include "parallel/mesh_regions.hpp"

namespace coastmesh {

// How a mesh is put into another one.
struct MergeOptions {
  double gradation = 0.2;  // above 0: how fast sizes change between the two
  MeshOptions mesh;        // bounds on the angles of new triangles
  DepthOptions depth;      // of new nodes; those without a value in any raster keep that of the triangles before
};

struct MergedMesh {
  MergeReport merged;                         // before the band between the two is meshed anew
  std::vector<MergeSource> nodes, triangles;  // of each of the result
  std::size_t replaced = 0;                   // triangles of the grid around the gap that are meshed anew
  std::optional<RemeshReport> band;           // nothing if nothing had to be
};

// Puts `inserted`, which is in the grid's CRS, into the grid (`mergeGrids`), and meshes the gap and triangles around it
// anew (`seamBand`), with sizes that grow or shrink from one mesh to the other. All other triangles, and all of the
// inserted mesh, stay bit for bit. Throws InputError, Cancelled.
MergedMesh mergeMesh(Grid& grid, Grid&& inserted, const MergeOptions& options, const RunControl& control = {},
                     const ItemLoop& loop = inOrder);

}  // namespace coastmesh
