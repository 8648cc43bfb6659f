#include "apps/job/places.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "gis/coast/feature_names.hpp"

namespace coastmesh {

std::string pointText(const Point& point) { return "(" + placeInWords(point) + ")"; }

std::string amount(const char* format, double number) {
  char text[60];
  std::snprintf(text, sizeof text, format, number);
  return text;
}

std::string roundAmount(double number, int digits) {
  constexpr double kWhole = 100.0, kMost = 1e7;
  char text[60];
  std::snprintf(text, sizeof text, "%.*g", digits, number);
  const double rounded = std::strtod(text, nullptr);
  return std::abs(rounded) < kWhole || std::abs(rounded) > kMost ? text : amount("%.0f", rounded);
}

}  // namespace coastmesh
