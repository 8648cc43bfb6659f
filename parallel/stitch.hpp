#pragma once

#include <vector>

#include "core/refine/submesh.hpp"
#include "parallel/cut.hpp"
#include "parallel/partition.hpp"
#include "parallel/recorder.hpp"

namespace coastmesh {

// Both combine all pieces of one partition, in order, whether processed or not, in the mesh that they were cut from.
// Its memory is reused: fresh memory costs more than writing to it, and a second large mesh beside the pieces would not
// fit. They restore the Delaunay property across the cuts, and mark the triangles that this changes as due.

// For a partition of all triangles. Vertices are renumbered: input vertices as before, then those on cuts, then each
// piece's own.
void stitch(std::vector<CutSubmesh>&& pieces, Recorder& recorder, MeshState& whole);

// For a partition of some triangles; the rest is unchanged. New items take the numbers of those they replace, then
// further ones at the end; if fewer are left, the last ones move to the free numbers.
void stitchInPlace(std::vector<CutSubmesh>&& pieces, const Partition& parts, Recorder& recorder, MeshState& whole);

}  // namespace coastmesh
