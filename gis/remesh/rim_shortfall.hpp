#pragma once

#include <cstdint>
#include <vector>

#include "core/refine/refine_options.hpp"
#include "core/tri_mesh.hpp"
#include "gis/remesh/remesh_patch.hpp"

namespace coastmesh {

// What the triangles that stay around a patch cost its new mesh.
struct RimShortfall {
  double squared_deg = 0.0;  // sum of squares of how much triangles miss the bounds on angles by
  // Of the grid, ascending: ends of shared edges at which such triangles, or else their neighbours, have a corner. A
  // larger patch may have none there.
  std::vector<std::uint32_t> nodes;
};

// Judges triangles at shared edges, or next to one that is; not those that a corner of shores alone excuses. `mesh` is
// of the patch's graph.
RimShortfall rimShortfall(const RemeshPatch& patch, const TriMesh& mesh, const RefineOptions& options);

}  // namespace coastmesh
