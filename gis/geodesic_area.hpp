#pragma once

#include <memory>
#include <optional>

#include "gis/coastline.hpp"
#include "gis/crs_map.hpp"
#include "gis/edge_area.hpp"

namespace coastmesh {

// Areas of rings given in one CRS; private to gis.
class RingArea {
 public:
  explicit RingArea(const Crs& crs);

  // The area that a ring encloses, never negative: on the ellipsoid in square metres, edges geodesic, or in the plane.
  // A ring around a pole without edges along the antimeridian encloses the smaller part of the globe.
  double of(const Ring& ring) const;

 private:
  double onEllipsoid(const Ring& lonlat) const;
  std::optional<double> awayFromPoles(const Ring& lonlat) const;

  bool plane_;
  std::unique_ptr<CrsMap> to_lonlat_;  // for projected CRS
  EdgeArea edges_;
};

}  // namespace coastmesh
