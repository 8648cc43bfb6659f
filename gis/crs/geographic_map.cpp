#include "gis/crs/geographic_map.hpp"

#include "gis/crs/crs_map.hpp"

namespace coastmesh {

GeographicMap::GeographicMap(const Crs& crs) {
  if (!crs.geographic) map_ = mapToGeographic(crs);
}

LonLat GeographicMap::forward(const Point& input) const { return asLonLat(map_ ? map_->forward(input) : input); }

Point GeographicMap::inverse(const LonLat& place) const {
  return map_ ? map_->inverse(asGeographic(place)) : asGeographic(place);
}

}  // namespace coastmesh
