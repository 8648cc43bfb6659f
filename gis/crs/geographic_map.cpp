#include "gis/crs/geographic_map.hpp"

#include "gis/crs/crs_map.hpp"
#include "gis/crs/ogr_support.hpp"

namespace coastmesh {

GeographicMap::GeographicMap(const Crs& crs) {
  if (!crs.geographic) map_ = std::make_shared<CrsMap>(toOgr(crs), geographicBase(crs));
}

LonLat GeographicMap::forward(const Point& input) const { return asLonLat(map_ ? map_->forward(input) : input); }

Point GeographicMap::inverse(const LonLat& place) const {
  return map_ ? map_->inverse(asGeographic(place)) : asGeographic(place);
}

}  // namespace coastmesh
