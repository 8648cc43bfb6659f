#pragma once

#include <optional>
#include <span>

#include "core/point.hpp"
#include "gis/crs/crs.hpp"
#include "gis/crs/geographic_map.hpp"
#include "gis/crs/space_ball.hpp"

namespace coastmesh {

// Balls around places of a CRS, with the Earth as a sphere: lower bounds of distances, across the antimeridian and the
// poles too, accurate to half a percent.
class GroundBalls {
 public:
  // Throws InputError if PROJ has no transformation.
  explicit GroundBalls(const Crs& crs);

  // The radius is not finite if a place has no image on Earth.
  SpaceBall around(std::span<const Point> places) const;

 private:
  SpacePoint inSpace(const Point& place) const;

  std::optional<GeographicMap> map_;  // nullopt for a plane
};

}  // namespace coastmesh
