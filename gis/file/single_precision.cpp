#include "gis/file/single_precision.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace coastmesh {

double shortestDecimal(float value) {
  if (!std::isfinite(value)) return static_cast<double>(value);
  std::array<char, 32> text{};
  const char* const end = std::to_chars(text.data(), text.data() + text.size(), value).ptr;
  double decimal = 0.0;
  std::from_chars(text.data(), end, decimal);
  return decimal;
}

}  // namespace coastmesh
