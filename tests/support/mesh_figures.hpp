#pragma once

#include <map>
#include <set>
#include <utility>

#include "core/edit_mesh.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

std::map<RegionId, double> areasByRegion(const TriMesh& mesh);

// Triangles by the places of their corners, free of numbering.
std::set<std::set<std::pair<double, double>>> trianglesByPlace(const TriMesh& mesh);

// What `mesh.release()` gives, all of region 0; the mesh itself stays.
TriMesh releasedCopy(EditMesh mesh);

}  // namespace coastmesh
