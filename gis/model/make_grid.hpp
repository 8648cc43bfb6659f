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

// A part of a grid.
struct MeshedDomain {
  const Domain* domain = nullptr;
  const TriMesh* mesh = nullptr;
  const std::vector<double>* size_m = nullptr;  // one for each vertex of the mesh; null if no sizes were requested
  const GroundPlaces* ground = nullptr;         // likewise, for angles and coordinates; null: the plane's
  // Called once the mesh's triangles, its largest part, are no longer needed: the caller may free them while much of
  // the grid is still to be made. May be empty.
  std::function<void()> triangles_done{};
};

// The grid of several meshed domains, in their order. `coastline.features` gives names; nodes of the PSLG keep the
// input's bits, Steiner points come from the domain's inverse projection.
Grid makeGrid(const std::vector<MeshedDomain>& parts, const Coastline& coastline, const ItemLoop& loop = inOrder);
// The same for a caller that frees the meshes before areas are computed, which needs memory of its own.
Grid makeGridWithoutAreas(const std::vector<MeshedDomain>& parts, const Coastline& coastline,
                          const ItemLoop& loop = inOrder);

}  // namespace coastmesh
