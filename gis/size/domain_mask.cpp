#include "gis/size/domain_mask.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/metric.hpp"
#include "core/size/on_surface.hpp"
#include "core/triangulate/delaunay.hpp"
#include "core/triangulate/label_regions.hpp"

namespace coastmesh {

namespace {

constexpr int kMostLevels = 12;
constexpr int kLeastShareLevels = 7, kMostShareLevels = 10;
constexpr double kHair = 1e-6;
constexpr double kCellsPerSegment = 16.0;

// The labelled boundary of the meshed area of a graph without labels, whose holes alone define the inside.
Pslg labelledBoundary(const Pslg& pslg) {
  const TriMesh mesh = constrainedDelaunay(pslg);
  Pslg boundary;
  boundary.points.assign(mesh.points.begin(), mesh.points.end());
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      if (mesh.twin(e) == kNone) boundary.segments.push_back({mesh.origin(e), mesh.target(e), 0, 0, kOutside});
    }
  }
  return boundary;
}

int levelsFor(const Pslg& pslg) {
  const double cells = kCellsPerSegment * static_cast<double>(pslg.segments.size());
  return std::clamp(static_cast<int>(std::ceil(0.5 * std::log2(cells))), 2, kMostLevels);
}

}  // namespace

DomainMask::DomainMask(const Pslg& pslg, const SizeBox& square, const Surface& surface)
    : origin_(square.centre - Point{square.half, square.half}), side_(2.0 * square.half), surface_(surface) {
  if (!hasRegions(pslg)) {
    const Pslg boundary = labelledBoundary(pslg);
    measureShares(boundary);
    listBoundary(boundary);
    return;
  }
  const int finest = levelsFor(pslg);
  measureShares(pslg);
  listBoundary(pslg);
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

// Crossings of segments with the centre lines of rows, from the left.
std::vector<std::vector<DomainMask::Crossing>> DomainMask::crossRows(const Pslg& pslg, int level) const {
  const auto n = std::int64_t{1} << level;
  const double per_unit = static_cast<double>(n) / side_;
  const auto rowOf = [&](double y) {
    return std::clamp(static_cast<std::int64_t>(std::floor(y)), std::int64_t{0}, n - 1);
  };
  std::vector<std::vector<Crossing>> crossings(static_cast<std::size_t>(n));
  for (const Segment& s : pslg.segments) {
    Point a = per_unit * (pslg.points[s.a] - origin_), b = per_unit * (pslg.points[s.b] - origin_);
    bool inside = s.right >= 0;
    if (b.y < a.y) {
      std::swap(a, b);
      inside = s.left >= 0;
    }
    // The segment runs upwards now, and `inside` is to its right.
    for (std::int64_t row = rowOf(a.y); row <= rowOf(b.y); ++row) {
      const double middle = static_cast<double>(row) + 0.5;
      if (!(a.y <= middle && middle < b.y)) continue;
      crossings[static_cast<std::size_t>(row)].push_back({a.x + (b.x - a.x) / (b.y - a.y) * (middle - a.y), inside});
    }
  }
  for (auto& across : crossings) std::ranges::sort(across, {}, &Crossing::x);
  return crossings;
}

void DomainMask::measureShares(const Pslg& pslg) {
  const int deepest = std::clamp(levelsFor(pslg), kLeastShareLevels, kMostShareLevels);
  shares_.resize(static_cast<std::size_t>(deepest) + 1);
  const std::size_t n = std::size_t{1} << deepest;
  std::vector<float>& cells = shares_.back();
  cells.assign(n * n, 0.0F);
  rows_ = crossRows(pslg, deepest);
  for (std::size_t row = 0; row < n; ++row) {
    const std::vector<Crossing>& across = rows_[row];
    for (std::size_t k = 0; k + 1 < across.size(); ++k) {
      if (!across[k].inside) continue;
      const double most = static_cast<double>(n);
      const double from = std::clamp(across[k].x, 0.0, most), to = std::clamp(across[k + 1].x, 0.0, most);
      for (auto i = static_cast<std::size_t>(from); i < n && static_cast<double>(i) < to; ++i) {
        const auto left = static_cast<double>(i);
        cells[row * n + i] += static_cast<float>(std::min(to, left + 1.0) - std::max(from, left));
      }
    }
  }
  for (int level = deepest - 1; level >= 0; --level) {
    const std::vector<float>& fine = shares_[static_cast<std::size_t>(level) + 1];
    std::vector<float>& coarse = shares_[static_cast<std::size_t>(level)];
    const std::size_t m = std::size_t{1} << level;
    coarse.resize(m * m);
    for (std::size_t j = 0; j < m; ++j) {
      for (std::size_t i = 0; i < m; ++i) {
        const std::size_t below = 4 * m * j + 2 * i;
        coarse[m * j + i] =
            shareOf({fine[below], fine[below + 1], fine[below + 2 * m], fine[below + 2 * m + 1]}, i, j, m);
      }
    }
  }
}

// The share of cell (i, j), in a level with `cells` cells per row, from those of its four quarters.
float DomainMask::shareOf(const std::array<float, 4>& below, std::size_t i, std::size_t j, std::size_t cells) const {
  if (!surface_.isCurved()) return 0.25F * (below[0] + below[1] + below[2] + below[3]);
  const double half = 0.25 * side_ / static_cast<double>(cells);
  double inside = 0.0, all = 0.0;
  for (std::size_t k = 0; k < 4; ++k) {
    const Point off{static_cast<double>(2 * (2 * i + k % 2) + 1), static_cast<double>(2 * (2 * j + k / 2) + 1)};
    const double area = areaOn(surface_, {origin_ + half * off, half});
    inside += area * static_cast<double>(below[k]);
    all += area;
  }
  return static_cast<float>(inside / all);
}

void DomainMask::listBoundary(const Pslg& pslg) {
  const int level = static_cast<int>(shares_.size()) - 1;
  const auto n = std::int64_t{1} << level;
  const double per_unit = static_cast<double>(n) / side_;
  const auto cellOf = [&](double x) {
    return std::clamp(static_cast<std::int64_t>(std::floor(x)), std::int64_t{0}, n - 1);
  };
  struct Entry {
    std::uint32_t cell, segment;
  };
  std::vector<Entry> entries;
  std::vector<BoundaryPiece> edges;
  for (const Segment& s : pslg.segments) {
    if ((s.left >= 0) == (s.right >= 0)) continue;
    BoundaryPiece boundary{per_unit * (pslg.points[s.a] - origin_), per_unit * (pslg.points[s.b] - origin_)};
    if (boundary.b.y < boundary.a.y) std::swap(boundary.a, boundary.b);
    const auto& [a, b] = boundary;
    for (std::int64_t row = cellOf(a.y); row <= cellOf(b.y); ++row) {
      const auto bottom = static_cast<double>(row);
      const auto xAt = [&](double y) {
        return b.y > a.y ? a.x + (b.x - a.x) * std::clamp((y - a.y) / (b.y - a.y), 0.0, 1.0) : a.x;
      };
      const double x0 = b.y > a.y ? xAt(bottom) : a.x, x1 = b.y > a.y ? xAt(bottom + 1.0) : b.x;
      for (std::int64_t i = cellOf(std::min(x0, x1) - kHair); i <= cellOf(std::max(x0, x1) + kHair); ++i)
        entries.push_back({static_cast<std::uint32_t>(row * n + i), static_cast<std::uint32_t>(edges.size())});
    }
    edges.push_back(boundary);
  }
  boundary_begin_.assign(static_cast<std::size_t>(n * n) + 1, 0);
  for (const Entry& entry : entries) ++boundary_begin_[entry.cell + 1];
  for (std::size_t c = 0; c + 1 < boundary_begin_.size(); ++c) boundary_begin_[c + 1] += boundary_begin_[c];
  boundary_.resize(entries.size());
  std::vector<std::uint32_t> next(boundary_begin_.begin(), boundary_begin_.end() - 1);
  for (const Entry& entry : entries) boundary_[next[entry.cell]++] = edges[entry.segment];
}

// The number of places (x, y) of a cell that are inside, for each of `ys`, in units of cells: counts crossings of the
// boundary on the way up or down from the row's centre line.
int DomainMask::holdsOf(double x, const std::array<double, kProbes>& ys, std::size_t cell) const {
  const std::size_t row = cell >> (shares_.size() - 1);
  const double middle = static_cast<double>(row) + 0.5;
  const auto after = std::ranges::upper_bound(rows_[row], x, {}, &Crossing::x);
  std::array<bool, kProbes> inside;
  inside.fill(after != rows_[row].begin() && std::prev(after)->inside);
  for (std::size_t r = boundary_begin_[cell]; r < boundary_begin_[cell + 1]; ++r) {
    const auto& [a, b] = boundary_[r];
    if ((a.x <= x) == (b.x <= x)) continue;
    const double y = a.y + (b.y - a.y) / (b.x - a.x) * (x - a.x);
    for (std::size_t k = 0; k < kProbes; ++k) inside[k] ^= (y <= middle) != (y <= ys[k]);
  }
  return static_cast<int>(std::ranges::count(inside, true));
}

double DomainMask::share(const SizeBox& box) const {
  const int finest = static_cast<int>(shares_.size()) - 1;
  const int deep = static_cast<int>(std::lround(std::log2(side_ / (2.0 * box.half))));
  const int level = std::clamp(deep, 0, finest);
  const auto n = std::int64_t{1} << level;
  const double per_unit = static_cast<double>(n) / side_;
  const Point at = per_unit * (box.centre - origin_);
  const auto cellOf = [&](double x) {
    return std::clamp(static_cast<std::int64_t>(std::floor(x)), std::int64_t{0}, n - 1);
  };
  const auto cell = static_cast<std::size_t>(n * cellOf(at.y) + cellOf(at.x));
  if (deep <= finest || boundary_begin_[cell] == boundary_begin_[cell + 1])
    return shares_[static_cast<std::size_t>(level)][cell];
  const auto probe = [&](std::size_t k) {
    return 2.0 * per_unit * box.half * ((static_cast<double>(k) + 0.5) / kProbes - 0.5);
  };
  std::array<double, kProbes> ys;
  for (std::size_t k = 0; k < kProbes; ++k) ys[k] = at.y + probe(k);
  int inside = 0;
  for (std::size_t k = 0; k < kProbes; ++k) inside += holdsOf(at.x + probe(k), ys, cell);
  return static_cast<double>(inside) / (kProbes * kProbes);
}

// Cells that a segment passes, and cells inside on their row's centre line.
std::vector<bool> DomainMask::rasterize(const Pslg& pslg, int level) const {
  const auto n = std::int64_t{1} << level;
  const double per_unit = static_cast<double>(n) / side_;
  std::vector<bool> cells(static_cast<std::size_t>(n * n), false);
  const auto cellOf = [&](double x) {
    return std::clamp(static_cast<std::int64_t>(std::floor(x)), std::int64_t{0}, n - 1);
  };
  const auto mark = [&](std::int64_t row, double from, double to) {
    for (std::int64_t i = cellOf(from - kHair); i <= cellOf(to + kHair); ++i)
      cells[static_cast<std::size_t>(row * n + i)] = true;
  };
  for (const Segment& s : pslg.segments) {
    Point a = per_unit * (pslg.points[s.a] - origin_), b = per_unit * (pslg.points[s.b] - origin_);
    if (b.y < a.y) std::swap(a, b);
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
    }
  }
  const std::vector<std::vector<Crossing>> crossings = crossRows(pslg, level);
  for (std::int64_t row = 0; row < n; ++row) {
    const std::vector<Crossing>& across = crossings[static_cast<std::size_t>(row)];
    for (std::size_t k = 0; k + 1 < across.size(); ++k)
      if (across[k].inside) mark(row, across[k].x, across[k + 1].x);
  }
  return cells;
}

bool DomainMask::meets(const SizeBox& box) const {
  if (levels_.empty()) return true;
  // At the finest level whose cells are at least as large as the box.
  const int level = std::clamp(static_cast<int>(std::floor(std::log2(side_ / (2.0 * box.half)) + 1e-9)), 0,
                               static_cast<int>(levels_.size()) - 1);
  const auto n = std::int64_t{1} << level;
  const double per_unit = static_cast<double>(n) / side_;
  const auto cellOf = [&](double x) {
    return std::clamp(static_cast<std::int64_t>(std::floor(x)), std::int64_t{0}, n - 1);
  };
  // Slightly smaller, because a box that is a cell shares its boundary with its neighbours.
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
