#pragma once

#include "core/pslg.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// Sets `mesh.regions` from the labels of the segments that contain the mesh's edges. REQUIRES: a carved mesh of this
// PSLG. Without labels every triangle belongs to region 0.
void labelRegions(TriMesh& mesh, const Pslg& pslg);

// Labels both sides of every segment, region 0 or kOutside, as holes and the outer boundary define them, and removes
// the holes. Does nothing if a segment has labels or there are no segments. Throws BadPslg.
void labelSegments(Pslg& pslg);

}  // namespace coastmesh
