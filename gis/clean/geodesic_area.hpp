#pragma once

#include <optional>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/clean/domain.hpp"
#include "gis/coast/coastline.hpp"
#include "gis/crs/edge_area.hpp"
#include "gis/crs/geographic_map.hpp"

namespace coastmesh {

// Areas of rings given in one CRS.
class RingArea {
 public:
  explicit RingArea(const Crs& crs);

  // The area that a ring encloses, never negative: on the ellipsoid in square metres, with geodesic edges, or in the
  // plane. A ring around a pole without edges along the antimeridian encloses the smaller part of the globe.
  double of(const Ring& ring) const;

 private:
  double onEllipsoid(const std::vector<LonLat>& ring) const;
  std::optional<double> awayFromPoles(const std::vector<LonLat>& ring) const;

  std::optional<GeographicMap> to_geographic_;  // nullopt for a plane
  EdgeArea edges_;
};

// Area of the group's polygons minus their holes, on the ellipsoid in square metres, with geodesic edges, or in the
// plane: the sum over all rings as they are, so that overlaps count twice.
double geodesicArea(const Coastline& coastline, const std::vector<std::size_t>& members,
                    const ItemLoop& loop = inOrder);

// Area of the domain by its labels, as above: each place counts once, whatever the rings of the input repeat.
double geodesicArea(const Domain& domain, const Crs& crs, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
