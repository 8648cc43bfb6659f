#include "apps/job/places.hpp"

#include <cstdio>

#include "gis/coast/feature_names.hpp"

namespace coastmesh {

std::string pointText(const Point& point) { return "(" + placeInWords(point) + ")"; }

std::string featureText(const Feature& feature) {
  return "'" + feature.source + "'" + (feature.fid < 0 ? "" : ", feature " + std::to_string(feature.fid));
}

std::string amount(const char* format, double number) {
  char text[60];
  std::snprintf(text, sizeof text, format, number);
  return text;
}

}  // namespace coastmesh
