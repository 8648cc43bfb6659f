#include "core/hilbert.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace coastmesh {

namespace {

// Orientation of the curve in a square: both coordinates mirrored, x and y exchanged, or both.
struct Pose {
  bool over = false;
  bool exchanged = false;
};

constexpr Pose poseOf(unsigned state) { return {(state & 1u) != 0, (state & 2u) != 0}; }

// Four levels of the curve at once. Key: the pose, four bits of each coordinate. Value: eight bits of the index and,
// above these, the pose on the next level.
constexpr std::array<std::uint16_t, 1024> makeSteps() {
  std::array<std::uint16_t, 1024> steps{};
  for (unsigned key = 0; key < steps.size(); ++key) {
    Pose pose = poseOf(key >> 8);
    unsigned index = 0;
    for (unsigned bit = 8; bit > 0; bit >>= 1) {
      const bool x = (key >> 4 & bit) != 0, y = (key & bit) != 0;
      const bool right = (pose.exchanged ? y : x) != pose.over, upper = (pose.exchanged ? x : y) != pose.over;
      index = index << 2 | ((right ? 3u : 0u) ^ (upper ? 1u : 0u));
      // In the lower quadrants the curve is rotated by a quarter turn.
      if (upper) continue;
      if (right) pose.over = !pose.over;
      pose.exchanged = !pose.exchanged;
    }
    steps[key] = static_cast<std::uint16_t>(index | (pose.over ? 1u : 0u) << 8 | (pose.exchanged ? 2u : 0u) << 8);
  }
  return steps;
}

constexpr std::array<std::uint16_t, 1024> kSteps = makeSteps();

// The numbers of the points in order of their indices; equal ones by number.
std::vector<std::uint32_t> sortedByIndex(std::span<const std::uint32_t> indices) {
  std::vector<std::uint64_t> keys(indices.size());
  for (std::size_t i = 0; i < keys.size(); ++i) keys[i] = std::uint64_t{indices[i]} << 32 | i;
  std::ranges::sort(keys);
  std::vector<std::uint32_t> order(keys.size());
  std::ranges::transform(keys, order.begin(), [](std::uint64_t key) { return static_cast<std::uint32_t>(key); });
  return order;
}

}  // namespace

std::uint32_t hilbertIndex(std::uint32_t x, std::uint32_t y) {
  std::uint32_t index = 0, state = 0;
  for (int shift = 12; shift >= 0; shift -= 4) {
    const std::uint32_t step = kSteps[state | (x >> shift & 15u) << 4 | (y >> shift & 15u)];
    index = index << 8 | (step & 255u);
    state = step & ~255u;
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
  // Too far apart or too close for doubles: any order will do.
  if (!std::isfinite(extent) || !std::isfinite(scale)) return indices;
  for (std::size_t i = 0; i < points.size(); ++i)
    indices[i] = hilbertIndex(static_cast<std::uint32_t>((points[i].x - left.x) * scale),
                              static_cast<std::uint32_t>((points[i].y - lower.y) * scale));
  return indices;
}

std::vector<std::uint32_t> hilbertOrder(std::span<const Point> points) {
  // Radix sort takes thousands of steps even for few points: a fifth of the total time for a lake of ten points.
  constexpr std::size_t kWorthCounting = 512;
  const std::vector<std::uint32_t> indices = hilbertIndices(points);
  if (points.size() < kWorthCounting) return sortedByIndex(indices);
  std::vector<std::uint32_t> order(points.size()), sorted(points.size());
  std::iota(order.begin(), order.end(), 0u);
  // Radix sort, last digit first; each pass is stable.
  constexpr unsigned kDigitBits = 11;
  for (unsigned shift = 0; shift < 32; shift += kDigitBits) {
    std::array<std::uint32_t, (1u << kDigitBits) + 1> first{};
    const auto digit = [&](std::uint32_t i) { return indices[i] >> shift & ((1u << kDigitBits) - 1); };
    for (const std::uint32_t i : order) ++first[digit(i) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    for (const std::uint32_t i : order) sorted[first[digit(i)]++] = i;
    order.swap(sorted);
  }
  return order;
}

std::vector<std::uint32_t> hilbertOrder(std::span<const Point> points, const Surface& surface) {
  if (!surface.isCurved()) return hilbertOrder(points);
  std::vector<Point> on_map(points.size());
  std::ranges::transform(points, on_map.begin(), [&](const Point& x) {
    const double shrink = std::sqrt(surface.shrinkAt(x));
    return Point{shrink * x.x, shrink * x.y};
  });
  return hilbertOrder(on_map);
}

}  // namespace coastmesh
