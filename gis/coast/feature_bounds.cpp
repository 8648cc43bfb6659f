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

}  // namespace coastmesh
