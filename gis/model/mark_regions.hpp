#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/item_loop.hpp"
#include "core/tri_mesh.hpp"
#include "gis/coast/coastline.hpp"
#include "gis/projection/projection.hpp"

namespace coastmesh {

// Assigns triangles inside a region to a copy of their feature with the region's name. Copies are appended to
// `names.features`, which `mesh.regions` index, in the order of the triangles. `members` are the group's features in
// `coastline`. Borders of regions are edges of the mesh, so that no triangle lies partly inside; of several regions the
// first counts. Returns the members that are such regions, ascending.
std::vector<std::uint32_t> markRegions(const Coastline& coastline, const std::vector<std::size_t>& members,
                                       const Projection& projection, TriMesh& mesh, Coastline& names,
                                       const ItemLoop& loop = inOrder);

}  // namespace coastmesh
