#include "gis/raster/raster_turn.hpp"

#include <cmath>

#include "gis/crs/geographic_map.hpp"

namespace coastmesh {

namespace {

constexpr double kTurn = 360.0;

// The degrees of longitude of one column in that row; 0 if latitudes change along the row, or degrees per column do.
double degreesPerColumn(const RasterGeometry& raster, const GeographicMap& map, double row) {
  constexpr int kProbes = 16;
  constexpr double kTolerance = 0.01;  // columns
  const auto at = [&](double column) { return map.forward(raster.placeOf({column, row})); };
  const double middle = 0.5 * raster.columns;
  const LonLat here = at(middle);
  const double step = std::remainder(at(middle + 1.0).lon - here.lon, kTurn);
  for (int k = 0; k <= kProbes; ++k) {
    const double column = static_cast<double>(raster.columns) * k / kProbes;
    const LonLat there = at(column);
    const double off = std::remainder(there.lon - here.lon - step * (column - middle), kTurn);
    if (!(std::hypot(off, there.lat - here.lat) <= kTolerance * std::abs(step))) return 0.0;
  }
  return step;
}

}  // namespace

RasterGeometry asSeenFrom(const Crs& places, RasterGeometry raster) {
  if (places.geographic && raster.crs.isPlane() && raster.to_place[1] != 0.0)
    raster.period = kTurn / std::abs(raster.to_place[1]);
  return raster;
}

double columnsOfTurn(const RasterGeometry& raster, const Crs& places) {
  const double period = asSeenFrom(places, raster).period;
  if (period > 0.0) return period;
  if (raster.crs.isPlane() || raster.crs.geographic || places.isPlane() || sameCrs(raster.crs, places)) return 0.0;
  constexpr double kAlike = 1e-6;
  const GeographicMap map(raster.crs);
  const double middle = degreesPerColumn(raster, map, 0.5 * raster.rows);
  const double upper = degreesPerColumn(raster, map, 0.25 * raster.rows);
  if (middle == 0.0 || !(std::abs(upper - middle) <= kAlike * std::abs(middle))) return 0.0;
  return kTurn / std::abs(middle);
}

}  // namespace coastmesh
