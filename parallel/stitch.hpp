#pragma once

#include <vector>

#include "core/refine/submesh.hpp"
#include "parallel/cut.hpp"
#include "parallel/partition.hpp"
#include "parallel/recorder.hpp"

namespace coastmesh {

// Both put together again what a mesh was cut into: all pieces of one partition, in order, each worked on or not, into
// the mesh that they were cut from. Its memory serves again: fresh memory costs more than what is written to it, and a
// large mesh has no room for a second one beside its pieces. They restore the Delaunay property across the cuts and
// mark the triangles that this changes as due.

// Of a partition of all triangles. Vertices are numbered anew: input vertices as before, then those on cuts, then each
// piece's own.
void stitch(std::vector<CutSubmesh>&& pieces, Recorder& recorder, MeshState& whole);

// Of a partition of some triangles; the rest stays as it is. What is new takes the numbers of what it replaces, then
// those behind the last; where less is left than was, the last ones take the numbers that are free.
void stitchInPlace(std::vector<CutSubmesh>&& pieces, const Partition& parts, Recorder& recorder, MeshState& whole);

}  // namespace coastmesh
