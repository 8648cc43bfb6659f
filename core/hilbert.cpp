#include "core/hilbert.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/distribute.hpp"

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

// Sorts numbers of points by the lower bits of the points' indices; equal ones keep their order.
void sortByIndex(std::span<const std::uint32_t> indices, unsigned bits, std::span<std::uint32_t> numbers) {
  // Radix sort takes thousands of steps even for few points: a fifth of the total time for a lake of ten points.
  constexpr std::size_t kWorthCounting = 512;
  const std::uint32_t mask = bits < 32 ? (1u << bits) - 1 : ~0u;
  if (numbers.size() < kWorthCounting) {
    std::vector<std::uint64_t> keys(numbers.size());
    for (std::size_t i = 0; i < keys.size(); ++i)
      keys[i] = std::uint64_t{indices[numbers[i]] & mask} << 32 | numbers[i];
    std::ranges::sort(keys);
    std::ranges::transform(keys, numbers.begin(), [](std::uint64_t key) { return static_cast<std::uint32_t>(key); });
    return;
  }
  // Last digit first; each pass is stable.
  constexpr unsigned kDigitBits = 11;
  std::vector<std::uint32_t> order(numbers.begin(), numbers.end()), sorted(numbers.size());
  for (unsigned shift = 0; shift < bits; shift += kDigitBits) {
    std::array<std::uint32_t, (1u << kDigitBits) + 1> first{};
    const auto digit = [&](std::uint32_t i) { return (indices[i] & mask) >> shift & ((1u << kDigitBits) - 1); };
    for (const std::uint32_t i : order) ++first[digit(i) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    for (const std::uint32_t i : order) sorted[first[digit(i)]++] = i;
    order.swap(sorted);
  }
  std::ranges::copy(order, numbers.begin());
}

// The least and the greatest coordinates.
std::pair<Point, Point> extentOf(std::span<const Point> points, const ItemLoop& loop) {
  const auto parts = overStretches(loop, points.size(), [&](std::size_t first, std::size_t last) {
    std::pair extent{points[first], points[first]};
    for (const Point& p : points.subspan(first, last - first)) {
      extent.first = {std::min(extent.first.x, p.x), std::min(extent.first.y, p.y)};
      extent.second = {std::max(extent.second.x, p.x), std::max(extent.second.y, p.y)};
    }
    return extent;
  });
  std::pair<Point, Point> all = parts.front();
  for (const auto& [low, high] : parts) {
    all.first = {std::min(all.first.x, low.x), std::min(all.first.y, low.y)};
    all.second = {std::max(all.second.x, high.x), std::max(all.second.y, high.y)};
  }
  return all;
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

std::vector<std::uint32_t> hilbertIndices(std::span<const Point> points, const ItemLoop& loop) {
  std::vector<std::uint32_t> indices(points.size());
  if (points.empty()) return indices;
  const auto [low, high] = extentOf(points, loop);
  const double extent = std::max(high.x - low.x, high.y - low.y);
  const double scale = extent > 0.0 ? 65535.0 / extent : 0.0;
  // Too far apart or too close for doubles: any order will do.
  if (!std::isfinite(extent) || !std::isfinite(scale)) return indices;
  forEachByStretches(loop, points.size(), [&, low = low](std::size_t i) {
    indices[i] = hilbertIndex(static_cast<std::uint32_t>((points[i].x - low.x) * scale),
                              static_cast<std::uint32_t>((points[i].y - low.y) * scale));
  });
  return indices;
}

BulkList<std::uint32_t> hilbertOrder(std::span<const Point> points, const ItemLoop& loop) {
  constexpr std::size_t kWorthDividing = 1 << 15;
  const std::vector<std::uint32_t> indices = hilbertIndices(points, loop);
  if (points.size() < kWorthDividing) {
    BulkList<std::uint32_t> order(points.size());
    std::iota(order.begin(), order.end(), 0u);
    sortByIndex(indices, 32, order);
    return order;
  }
  // By the upper bits first, so that the rest can be sorted at the same time.
  constexpr unsigned kUpperBits = 8, kLowerBits = 32 - kUpperBits;
  constexpr std::size_t kParts = std::size_t{1} << kUpperBits;
  auto [order, starts] =
      distribute(loop, points.size(), kParts, [&](std::size_t i) { return indices[i] >> kLowerBits; });
  loop(kParts, [&, &order = order, &starts = starts](std::size_t p) {
    sortByIndex(indices, kLowerBits, std::span(order).subspan(starts[p], starts[p + 1] - starts[p]));
  });
  return order;
}

BulkList<std::uint32_t> hilbertOrder(std::span<const Point> points, const Surface& surface, const ItemLoop& loop) {
  if (!surface.isCurved()) return hilbertOrder(points, loop);
  BulkList<Point> on_map = unsetList<Point>(points.size());
  forEachByStretches(loop, points.size(), [&](std::size_t i) {
    const double shrink = std::sqrt(surface.shrinkAt(points[i]));
    on_map[i] = {shrink * points[i].x, shrink * points[i].y};
  });
  return hilbertOrder(on_map, loop);
}

}  // namespace coastmesh
