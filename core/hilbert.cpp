#include "core/hilbert.hpp"

#include <algorithm>
#include <utility>

namespace coastmesh {

std::uint32_t hilbertIndex(std::uint32_t x, std::uint32_t y) {
  std::uint32_t index = 0;
  for (std::uint32_t side = 1u << 15; side > 0; side >>= 1) {
    const bool right = (x & side) != 0, upper = (y & side) != 0;
    index = index << 2 | ((right ? 3u : 0u) ^ (upper ? 1u : 0u));
    if (upper) continue;
    // The lower quadrants hold the curve turned by a quarter.
    if (right) {
      x = ~x & 0xFFFFu;
      y = ~y & 0xFFFFu;
    }
    std::swap(x, y);
  }
  return index;
}

std::vector<std::uint32_t> hilbertIndices(std::span<const Point> points) {
  std::vector<std::uint32_t> indices(points.size());
  if (points.empty()) return indices;
  const auto [left, right] = std::ranges::minmax(points, {}, &Point::x);
  const auto [lower, upper] = std::ranges::minmax(points, {}, &Point::y);
  const double extent = std::max(right.x - left.x, upper.y - lower.y);
  const double scale = extent > 0.0 ? 65535.0 / extent : 0.0;
  for (std::size_t i = 0; i < points.size(); ++i)
    indices[i] = hilbertIndex(static_cast<std::uint32_t>((points[i].x - left.x) * scale),
                              static_cast<std::uint32_t>((points[i].y - lower.y) * scale));
  return indices;
}

}  // namespace coastmesh
