#include "gis/coast/feature_bounds.hpp"

namespace coastmesh {

Box boundsOf(const Feature& feature) {
  Box box;
  for (const Polygon& polygon : feature.polygons) {
    for (const Point& p : polygon.outer) box.add(p);
    for (const Ring& hole : polygon.holes) {
      for (const Point& p : hole) box.add(p);
    }
  }
  for (const auto& line : feature.lines) {
    for (const Point& p : line) box.add(p);
  }
  for (const Point& p : feature.points) box.add(p);
  return box;
}

std::size_t pointsOf(const Feature& feature) {
  std::size_t count = 0;
  for (const Polygon& polygon : feature.polygons) {
    count += polygon.outer.size();
    for (const Ring& hole : polygon.holes) count += hole.size();
  }
  for (const auto& line : feature.lines) count += line.size();
  return count;
}

Box boundsOfFrames(const Coastline& coastline) {
  Box bounds;
  for (const Feature& feature : coastline.features)
    if (feature.use == FeatureUse::Frame) bounds.add(boundsOf(feature));
  return bounds;
}

bool meetAtAnyTurn(const Box& a, const Box& b, const Crs& crs) {
  if (!crs.geographic) return a.meets(b);
  for (const double turn : {0.0, -360.0, 360.0})
    if (a.meets({b.xmin + turn, b.ymin, b.xmax + turn, b.ymax})) return true;
  return false;
}

}  // namespace coastmesh
