#pragma once

#include <cstddef>
#include <vector>

#include "core/item_loop.hpp"
#include "core/tri_mesh.hpp"
#include "gis/coast/coastline.hpp"
#include "gis/projection/projection.hpp"

namespace coastmesh {

// Triangles in a region belong to a part of their feature that says so: `mesh.regions`, which index `names.features`,
// then refer to parts appended there, numbered in the order of the triangles. `members` are the group's features in
// `coastline`. Borders of regions are edges of the mesh, so that each triangle lies in one as a whole; of several
// regions the first counts.
void markRegions(const Coastline& coastline, const std::vector<std::size_t>& members, const Projection& projection,
                 TriMesh& mesh, Coastline& names, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
