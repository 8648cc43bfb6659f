#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/clean/domain.hpp"
#include "gis/coast/coastline.hpp"
#include "gis/crs/crs_map.hpp"
#include "gis/crs/edge_area.hpp"

namespace coastmesh {

// Areas of rings given in one CRS.
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

// Area of the group's polygons on the ellipsoid (or in the plane), holes taken out, in square metres, edges geodesic.
double geodesicArea(const Coastline& coastline, const std::vector<std::size_t>& members,
                    const ItemLoop& loop = inOrder);

// Area of what the domain's labels hold, as above.
double geodesicArea(const Domain& domain, const Crs& crs);

}  // namespace coastmesh
