#pragma once

#include <map>
#include <set>
#include <utility>

#include "core/edit_mesh.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

std::map<RegionId, double> areasByRegion(const TriMesh& mesh);

// Triangles as sets of corner coordinates, independent of numbering.
std::set<std::set<std::pair<double, double>>> trianglesByPlace(const TriMesh& mesh);

// The result of `mesh.release()` on a copy of the mesh, with all triangles in region 0.
TriMesh releasedCopy(EditMesh mesh);

}  // namespace coastmesh
