#include "gis/places.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace coastmesh {

std::string placeInWords(const Point& place) {
  char text[64];
  std::snprintf(text, sizeof text, "%.10g, %.10g", place.x, place.y);
  return text;
}

std::string roughPlaceInWords(const Point& place) {
  const auto digits = [](double x) { return std::abs(x) < 1e4 ? 6 : 9; };
  char text[64];
  std::snprintf(text, sizeof text, "%.*g, %.*g", digits(place.x), place.x, digits(place.y), place.y);
  return text;
}

std::string pointText(const Point& point) { return "(" + placeInWords(point) + ")"; }

std::string listed(const std::vector<std::string>& names, std::size_t most) {
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i) text += (i > 0 ? ", " : "") + names[i];
  return names.size() > most ? text + ", and " + std::to_string(names.size() - most) + " more" : text;
}

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

std::string atMost(double number) {
  std::string text = amount("%.3g", number);
  const double rounded = std::strtod(text.c_str(), nullptr);
  if (rounded <= number) return text;
  const double unit = std::pow(10.0, std::floor(std::log10(number)) - 2.0);  // of the third digit
  return amount("%.3g", rounded - unit);
}

}  // namespace coastmesh
