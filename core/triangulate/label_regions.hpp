#pragma once

#include "core/item_loop.hpp"
#include "core/pslg.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// Sets `mesh.regions` from the labels of the segments that contain the mesh's edges. REQUIRES: a carved mesh of this
// PSLG. Without labels every triangle belongs to region 0. `loop` speeds up meshes of one region.
void labelRegions(TriMesh& mesh, const Pslg& pslg, const ItemLoop& loop = inOrder);

// True if a segment of the graph has a region beside it.
bool hasRegions(const Pslg& pslg);

// For a labelled graph: true if one side alone is in a region. False for lines inside and for borders between regions.
inline bool isBoundary(const Segment& s) { return (s.left >= 0) != (s.right >= 0); }

// Labels both sides of every segment, region 0 or kOutside, as holes and the outer boundary define them, and removes
// the holes. Does nothing if a segment has labels or there are no segments. Throws BadPslg.
void labelSegments(Pslg& pslg);

}  // namespace coastmesh
