#pragma once

#include <functional>
#include <vector>

#include "core/item_loop.hpp"
#include "core/tri_mesh.hpp"
#include "gis/clean/domain.hpp"
#include "gis/coast/coastline.hpp"
#include "gis/grid/grid.hpp"
#include "gis/projection/projection.hpp"

namespace coastmesh {

// The grid of several meshed domains, in their order. `coastline.features` gives names; nodes of the PSLG have the
// input's own bits, Steiner points come from the domain's inverse projection.
struct MeshedDomain {
  const Domain* domain = nullptr;
  const TriMesh* mesh = nullptr;
  const std::vector<double>* size_m = nullptr;  // one for each vertex of the mesh; null if no sizes were requested
  const GroundPlaces* ground = nullptr;         // likewise, for angles and coordinates; null: those of the plane
  // Called when the mesh's triangles, its largest part, are no longer used while much of the grid is still to be made:
  // the caller may then free them. May be empty.
  std::function<void()> triangles_done{};
};
Grid makeGrid(const std::vector<MeshedDomain>& parts, const Coastline& coastline, const ItemLoop& loop = inOrder);
// The same for a caller that frees the meshes before areas are computed, which needs memory of its own.
Grid makeGridWithoutAreas(const std::vector<MeshedDomain>& parts, const Coastline& coastline,
                          const ItemLoop& loop = inOrder);

}  // namespace coastmesh
