#include "gis/rivers/river_plane.hpp"

#include <cmath>

#include "gis/coast/coastline.hpp"
#include "gis/geometry/box.hpp"

namespace coastmesh {

namespace {

Projection projectionFor(const std::vector<RiverLine>& lines, const Crs& crs) {
  Coastline coastline;
  coastline.crs = crs;
  Feature& all = coastline.features.emplace_back();
  for (const RiverLine& line : lines) all.lines.push_back(line.points);
  return Projection::fitted(coastline, {0});
}

}  // namespace

RiverPlane::RiverPlane(const std::vector<RiverLine>& lines, const Crs& crs)
    : projection_(projectionFor(lines, crs)), geographic_(crs.geographic) {
  Box box;
  for (const RiverLine& line : lines)
    for (const Point& p : line.points) box.add(p);
  middle_ = 0.5 * (box.xmin + box.xmax);
}

Point RiverPlane::inverse(const Point& plane) const {
  Point place = projection_.inverse(plane);
  constexpr double kTurn = 360.0;
  if (geographic_) place.x += kTurn * std::round((middle_ - place.x) / kTurn);
  return place;
}

}  // namespace coastmesh
