#pragma once

#include "core/pslg.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// Fills `mesh.regions` from the labels of the segments that the mesh's edges are pieces of. REQUIRES: a carved mesh of
// this PSLG. Without labels every triangle belongs to region 0.
void labelRegions(TriMesh& mesh, const Pslg& pslg);

}  // namespace coastmesh
