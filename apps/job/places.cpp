#include "apps/job/places.hpp"

#include <cstdio>

namespace coastmesh {

std::string pointText(const Point& point) {
  char text[80];
  std::snprintf(text, sizeof text, "(%.10g, %.10g)", point.x, point.y);
  return text;
}

std::string featureText(const Feature& feature) {
  return "'" + feature.source + "'" + (feature.fid < 0 ? "" : ", feature " + std::to_string(feature.fid));
}

}  // namespace coastmesh
