#pragma once

#include <optional>

#include "core/item_loop.hpp"
#include "core/point.hpp"
#include "core/surface.hpp"
#include "gis/grid/grid.hpp"
#include "gis/grid/on_sphere.hpp"

namespace coastmesh {

// The plane in which a mesh is put into one whose longitudes jump: the Earth projected stereographically from the place
// opposite to the middle of the inserted mesh, in metres. Conformal on the sphere, so that poles and the antimeridian
// are like other places; only triangles at the opposite side of the Earth are not as they are on it.
class NestPlane {
 public:
  // Nullopt if longitudes and latitudes of both meshes can be used as they are: no triangle jumps or has a pole. Throws
  // InputError if the inserted mesh reaches so far that its plane would not show it well.
  static std::optional<NestPlane> around(const Grid& grid, const Grid& inserted, const ItemLoop& loop = inOrder);

  Point forward(const Point& lon_lat) const;
  Point inverse(const Point& plane) const;
  // The grid in this plane.
  Grid flat(const Grid& grid, const ItemLoop& loop = inOrder) const;
  // True for places of the plane on the other side of the Earth.
  bool isFar(const Point& plane) const;

 private:
  NestPlane(const SphereVector& middle, double radius_m);

  SphereVector middle_, east_, north_;
  Surface surface_;  // its origin is the middle
};

// Moves the longitudes of the inserted mesh by whole turns into the turn that the grid's are in. Those that are in it
// stay as they are.
void matchTurn(Grid& inserted, const Grid& grid);

}  // namespace coastmesh
