#pragma once

#include "core/pslg.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// Fills `mesh.regions` from the labels of the segments that the mesh's edges are pieces of. REQUIRES: a carved mesh of
// this PSLG. Without labels every triangle belongs to region 0.
void labelRegions(TriMesh& mesh, const Pslg& pslg);

// Labels both sides of every segment, region 0 or kOutside, where holes and the outer boundary said so far what is
// inside; the holes go. Does nothing where a segment is labelled, or none is there. Throws BadPslg.
void labelSegments(Pslg& pslg);

}  // namespace coastmesh
