#include "gis/domain_mask.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/metric.hpp"

namespace coastmesh {

namespace {

constexpr int kMostLevels = 12;
constexpr double kCellsPerSegment = 16.0;

}  // namespace

DomainMask::DomainMask(const Pslg& pslg, const SizeBox& square)
    : origin_(square.centre - Point{square.half, square.half}), side_(2.0 * square.half) {
  if (std::ranges::none_of(pslg.segments, [](const Segment& s) { return s.left >= 0 || s.right >= 0; })) return;
  const double cells = kCellsPerSegment * static_cast<double>(pslg.segments.size());
  const int finest = std::clamp(static_cast<int>(std::ceil(0.5 * std::log2(cells))), 2, kMostLevels);
  levels_.resize(static_cast<std::size_t>(finest) + 1);
  levels_.back() = rasterize(pslg, finest);
  for (int level = finest - 1; level >= 0; --level) {
    const std::vector<bool>& fine = levels_[static_cast<std::size_t>(level) + 1];
    const std::size_t n = std::size_t{1} << level;
    std::vector<bool>& coarse = levels_[static_cast<std::size_t>(level)];
    coarse.resize(n * n);
    for (std::size_t j = 0; j < n; ++j) {
      for (std::size_t i = 0; i < n; ++i) {
        const std::size_t below = 4 * n * j + 2 * i;
        coarse[n * j + i] = fine[below] || fine[below + 1] || fine[below + 2 * n] || fine[below + 2 * n + 1];
      }
    }
  }
}

// Cells that a segment passes, and cells whose middle lies inside.
std::vector<bool> DomainMask::rasterize(const Pslg& pslg, int level) const {
  const auto n = std::int64_t{1} << level;
  const double per_unit = static_cast<double>(n) / side_;
  std::vector<bool> cells(static_cast<std::size_t>(n * n), false);
  const auto cellOf = [&](double x) {
    return std::clamp(static_cast<std::int64_t>(std::floor(x)), std::int64_t{0}, n - 1);
  };
  const auto mark = [&](std::int64_t row, double from, double to) {
    constexpr double kHair = 1e-6;
    for (std::int64_t i = cellOf(from - kHair); i <= cellOf(to + kHair); ++i)
      cells[static_cast<std::size_t>(row * n + i)] = true;
  };
  struct Crossing {
    double x;
    bool inside;  // to its right
  };
  std::vector<std::vector<Crossing>> crossings(static_cast<std::size_t>(n));  // of lines through the middles of rows
  for (const Segment& s : pslg.segments) {
    Point a = per_unit * (pslg.points[s.a] - origin_), b = per_unit * (pslg.points[s.b] - origin_);
    bool inside = s.right >= 0;
    if (b.y < a.y) {
      std::swap(a, b);
      inside = s.left >= 0;
    }
    // Upwards now, with `inside` to the right.
    const double run = b.y > a.y ? (b.x - a.x) / (b.y - a.y) : 0.0;
    const auto xAt = [&](double y) { return a.x + run * (y - a.y); };
    for (std::int64_t row = cellOf(a.y - 1e-6); row <= cellOf(b.y + 1e-6); ++row) {
      const auto bottom = static_cast<double>(row);
      if (b.y > a.y) {
        const double x0 = xAt(std::clamp(bottom, a.y, b.y)), x1 = xAt(std::clamp(bottom + 1.0, a.y, b.y));
        mark(row, std::min(x0, x1), std::max(x0, x1));
      } else {
        mark(row, std::min(a.x, b.x), std::max(a.x, b.x));
      }
      const double middle = bottom + 0.5;
      if (a.y <= middle && middle < b.y) crossings[static_cast<std::size_t>(row)].push_back({xAt(middle), inside});
    }
  }
  for (std::int64_t row = 0; row < n; ++row) {
    auto& across = crossings[static_cast<std::size_t>(row)];
    std::ranges::sort(across, {}, &Crossing::x);
    for (std::size_t k = 0; k + 1 < across.size(); ++k)
      if (across[k].inside) mark(row, across[k].x, across[k + 1].x);
  }
  return cells;
}

bool DomainMask::meets(const SizeBox& box) const {
  if (levels_.empty()) return true;
  // At the level whose cells are as large as the box, or the finest.
  const int level = std::clamp(static_cast<int>(std::floor(std::log2(side_ / (2.0 * box.half)) + 1e-9)), 0,
                               static_cast<int>(levels_.size()) - 1);
  const auto n = std::int64_t{1} << level;
  const double per_unit = static_cast<double>(n) / side_;
  const auto cellOf = [&](double x) {
    return std::clamp(static_cast<std::int64_t>(std::floor(x)), std::int64_t{0}, n - 1);
  };
  // A box that is a cell meets its neighbours in nothing but its rim.
  const double half = box.half * (1.0 - 1e-9);
  const Point low = per_unit * (box.centre - Point{half, half} - origin_);
  const Point high = per_unit * (box.centre + Point{half, half} - origin_);
  const std::vector<bool>& cells = levels_[static_cast<std::size_t>(level)];
  for (std::int64_t j = cellOf(low.y); j <= cellOf(high.y); ++j)
    for (std::int64_t i = cellOf(low.x); i <= cellOf(high.x); ++i)
      if (cells[static_cast<std::size_t>(n * j + i)]) return true;
  return false;
}

}  // namespace coastmesh
