#include "apps/job/places.hpp"

#include <cstdio>

#include "gis/coast/feature_names.hpp"

namespace coastmesh {

std::string pointText(const Point& point) { return "(" + placeInWords(point) + ")"; }

std::string amount(const char* format, double number) {
  char text[60];
  std::snprintf(text, sizeof text, format, number);
  return text;
}

}  // namespace coastmesh
