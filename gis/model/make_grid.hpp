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

// The grid of several meshed domains, in their order. `coastline.features` gives names; nodes of the PSLG come back
// with the input's own bits, Steiner points through the domain's inverse projection.
struct MeshedDomain {
  const Domain* domain = nullptr;
  const TriMesh* mesh = nullptr;
  const std::vector<double>* size_m = nullptr;  // one a vertex of the mesh; null where no lengths were asked for
  const GroundPlaces* ground = nullptr;         // likewise, for angles and coordinates; null: those of the plane
  // Called when nothing more looks at the mesh's triangles, its largest part, and much of the grid is still to be made:
  // whoever needs them no more may give them back. May be empty.
  std::function<void()> triangles_done{};
};
Grid makeGrid(const std::vector<MeshedDomain>& parts, const Coastline& coastline, const ItemLoop& loop = inOrder);
// The same for who gives back the meshes before areas are worked out, which takes memory of its own.
Grid makeGridWithoutAreas(const std::vector<MeshedDomain>& parts, const Coastline& coastline,
                          const ItemLoop& loop = inOrder);

}  // namespace coastmesh
