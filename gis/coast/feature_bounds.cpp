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
