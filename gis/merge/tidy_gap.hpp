#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/tri_mesh.hpp"
#include "gis/crs/crs.hpp"
#include "gis/grid/boundary_chains.hpp"

namespace coastmesh {

// The part of a merged mesh that may change.
struct Gap {
  TriId first_inserted = 0,
        first_gap = 0;            // triangles of the inserted mesh come before those of the gap, which are last
  std::vector<NodePair> shore;    // sorted keys of the edges of the gap that were boundary before
  std::vector<VertexId> changed;  // nodes where triangles of the other mesh were taken out, or both meshes meet
  Crs crs;                        // of the mesh's points
};

// Clears the flags in `taken` of triangles of the gap that models would reject, or beside which no good ones fit: with
// two sides, other than those of `shore`, where nothing taken lies across; connected to the others around a node only
// through it; around a corner of the water, or between a shore and an edge of the inserted mesh, with too small an
// angle. Those of the other mesh that only a changed node connects to the rest go too. No island is made:
// what the others enclose stays. Returns how many.
std::size_t tidyGap(const TriMesh& mesh, const Gap& gap, std::vector<std::uint8_t>& taken);

}  // namespace coastmesh
