#include "gis/merge/seam_band.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <span>
#include <utility>

#include "gis/crs/geodesy.hpp"

namespace coastmesh {

namespace {

// Lengths that differ by less than this share of the shorter one need no transition.
constexpr double kAlike = 0.5;

class BandFinder {
 public:
  BandFinder(const Grid& grid, const MergeReport& merged, double gradation, const ItemLoop& loop)
      : grid_(grid), merged_(merged), gradation_(gradation), meter_(grid.nodes, grid.crs, loop) {
    band_.taken.assign(grid.triangles.size(), 0);
    listTriangles();
  }

  SeamBand find() {
    const std::size_t nodes = grid_.nodes.size();
    distance_.assign(nodes, std::numeric_limits<double>::infinity());
    length_.assign(nodes, 0.0);
    startAtSeam();
    takeAroundGap();
    while (!queue_.empty()) {
      const auto [d, node] = queue_.top();
      queue_.pop();
      if (d > distance_[node]) continue;
      for (const std::uint32_t t : trianglesAt(node)) {
        if (isInserted(t) || !(isGap(t) || isTooLarge(t, node))) continue;
        take(t);
        for (const std::uint32_t other : grid_.triangles[t]) relax(other, d + meter_.between(node, other), node);
      }
    }
    return std::move(band_);
  }

 private:
  bool isInserted(std::uint32_t t) const { return merged_.triangles[t].mesh == 1; }
  bool isGap(std::uint32_t t) const { return merged_.triangles[t].mesh == kNone; }

  // The triangles at each node, one list after another.
  void listTriangles() {
    first_.assign(grid_.nodes.size() + 1, 0);
    for (const auto& corners : grid_.triangles)
      for (const std::uint32_t node : corners) ++first_[node + 1];
    for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    listed_.resize(3 * grid_.triangles.size());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    for (std::uint32_t t = 0; t < grid_.triangles.size(); ++t)
      for (const std::uint32_t node : grid_.triangles[t]) listed_[next[node]++] = t;
  }

  std::span<const std::uint32_t> trianglesAt(std::uint32_t node) const {
    return std::span(listed_).subspan(first_[node], first_[node + 1] - first_[node]);
  }

  double meanEdge(std::uint32_t t) const {
    const auto [a, b, c] = meter_.of(grid_.triangles[t]);
    return (a + b + c) / 3.0;
  }

  void startAtSeam() {
    for (std::uint32_t node = 0; node < grid_.nodes.size(); ++node) {
      double sum = 0.0;
      std::size_t count = 0, others = 0;
      bool fits = merged_.of_both[node] != 0;  // both meshes are there as they were
      for (const std::uint32_t t : trianglesAt(node)) {
        fits = fits && !isGap(t);
        if (isInserted(t)) {
          sum += meanEdge(t);
          ++count;
        } else {
          ++others;
        }
      }
      if (count == 0 || others == 0 || fits) continue;
      distance_[node] = 0.0;
      length_[node] = sum / static_cast<double>(count);
      band_.largest = std::max(band_.largest, length_[node]);
      queue_.emplace(0.0, node);
    }
  }

  // The gap's triangles are large and small at random, so that the new ones need room beside them.
  void takeAroundGap() {
    for (std::uint32_t t = 0; t < grid_.triangles.size(); ++t) {
      if (!isGap(t)) continue;
      take(t);
      for (const std::uint32_t node : grid_.triangles[t])
        for (const std::uint32_t beside : trianglesAt(node))
          if (!isInserted(beside)) take(beside);
    }
  }

  void take(std::uint32_t t) {
    if (band_.taken[t] != 0) return;
    band_.taken[t] = 1;
    ++band_.triangles;
    if (!isGap(t)) band_.largest = std::max(band_.largest, meanEdge(t));
  }

  bool isTooLarge(std::uint32_t t, std::uint32_t node) const {
    const double own = meanEdge(t), of_seam = length_[node];
    return std::abs(own - of_seam) - kAlike * std::min(own, of_seam) > gradation_ * (distance_[node] + 0.5 * own);
  }

  void relax(std::uint32_t node, double d, std::uint32_t from) {
    if (d >= distance_[node]) return;
    distance_[node] = d;
    length_[node] = length_[from];
    queue_.emplace(d, node);
  }

  const Grid& grid_;
  const MergeReport& merged_;
  double gradation_;
  EdgeMeter meter_;
  SeamBand band_;
  std::vector<std::uint32_t> first_, listed_;
  std::vector<double> distance_;  // of each node to the seam along edges
  std::vector<double> length_;    // the mean edge of the inserted triangles there
  using Entry = std::pair<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;
};

}  // namespace

SeamBand seamBand(const Grid& grid, const MergeReport& merged, double gradation, const ItemLoop& loop) {
  return BandFinder(grid, merged, gradation, loop).find();
}

}  // namespace coastmesh
