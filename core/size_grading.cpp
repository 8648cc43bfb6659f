#include "core/size_grading.hpp"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

#include "core/ids.hpp"
#include "core/metric.hpp"

namespace coastmesh {

namespace {

// The rim of a cell counter-clockwise.
constexpr std::array<unsigned, 8> kRim = {0, 1, 2, 5, 8, 7, 6, 3};

// Sizes grow a little slower than they may: on the way from one cell into the next another place may come to decide. What is only just
// steeper than asked, by rounding, is left.
constexpr double kSteep = 1.0 + 1e-6;

template <typename F>
void forEachTriangle(const LeafVertices& leaf, F&& triangle) {
  std::uint32_t first = kNone, last = kNone;
  for (const unsigned i : kRim) {
    if (leaf[i] == kNone) continue;
    if (last != kNone) triangle(leaf[4], last, leaf[i]);
    if (first == kNone) first = leaf[i];
    last = leaf[i];
  }
  triangle(leaf[4], last, first);
}

double slopeOf(const Point& a, const Point& b, const Point& c, double ha, double hb, double hc) {
  const Point ab = b - a, ac = c - a;
  const Point gradient = (hb - ha) * Point{ac.y, -ac.x} + (hc - ha) * Point{-ab.y, ab.x};
  return std::sqrt(squaredLength(gradient)) / std::abs(cross(ab, ac));
}

class Grader {
 public:
  Grader(std::vector<double>& sizes, std::span<const Point> places, std::span<const LeafVertices> leaves, double grade)
      : sizes_(sizes), places_(places), leaves_(leaves), grade_(kSizeGrowth * grade), steep_(kSteep * grade) {}

  // The place that decides on the size at each vertex; kNone where that is the size wanted there.
  std::vector<std::uint32_t> run() {
    std::vector<std::uint32_t> low;
    findSteep(low);
    if (low.empty()) return {};
    findLeavesRound();
    return spread(low);
  }

 private:
  struct Entry {
    double size;
    std::uint32_t vertex;
    bool operator<(const Entry& other) const { return size != other.size ? size > other.size : vertex > other.vertex; }
  };

  double slope(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return slopeOf(places_[a], places_[b], places_[c], sizes_[a], sizes_[b], sizes_[c]);
  }

  // The lowest vertices of triangles that are too steep.
  void findSteep(std::vector<std::uint32_t>& low) const {
    for (const LeafVertices& leaf : leaves_) {
      forEachTriangle(leaf, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
        if (slope(a, b, c) > steep_)
          low.push_back(std::min({a, b, c}, [&](auto v, auto w) { return sizes_[v] < sizes_[w]; }));
      });
    }
    std::ranges::sort(low);
    low.erase(std::unique(low.begin(), low.end()), low.end());
  }

  void findLeavesRound() {
    first_.assign(sizes_.size() + 1, 0);
    const auto forEachVertex = [&](auto&& f) {
      for (std::uint32_t l = 0; l < leaves_.size(); ++l)
        for (const std::uint32_t v : leaves_[l])
          if (v != kNone) f(v, l);
    };
    forEachVertex([&](std::uint32_t v, std::uint32_t) { ++first_[v + 1]; });
    for (std::size_t v = 0; v + 1 < first_.size(); ++v) first_[v + 1] += first_[v];
    round_.resize(first_.back());
    std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
    forEachVertex([&](std::uint32_t v, std::uint32_t l) { round_[next[v]++] = l; });
  }
  std::span<const std::uint32_t> leavesRound(std::uint32_t v) const {
    return std::span(round_).subspan(first_[v], first_[v + 1] - first_[v]);
  }

  // From each low place sizes grow with the straight distance from it, not with that along edges: every vertex knows the place that
  // decides.
  std::vector<std::uint32_t> spread(const std::vector<std::uint32_t>& low) {
    std::vector<std::uint32_t> source(sizes_.size(), kNone);
    const std::vector<double> own(sizes_);
    std::priority_queue<Entry> queue;
    for (const std::uint32_t v : low) {
      source[v] = v;
      queue.push({sizes_[v], v});
    }
    while (!queue.empty()) {
      const auto [size, v] = queue.top();
      queue.pop();
      if (size != sizes_[v]) continue;
      const std::uint32_t from = source[v] == kNone ? v : source[v];
      for (const std::uint32_t l : leavesRound(v)) {
        for (const std::uint32_t w : leaves_[l]) {
          if (w == kNone) continue;
          const double allowed = own[from] + grade_ * distance(places_[from], places_[w]);
          if (!(allowed < sizes_[w] * (1.0 - 1e-9))) continue;
          sizes_[w] = allowed;
          source[w] = from;
          queue.push({allowed, w});
        }
      }
    }
    return source;
  }

  std::vector<double>& sizes_;
  std::span<const Point> places_;
  std::span<const LeafVertices> leaves_;
  double grade_, steep_;
  std::vector<std::uint32_t> first_, round_;  // the leaves round each vertex
};

}  // namespace

std::vector<std::uint32_t> gradeSizes(std::vector<double>& sizes, std::span<const Point> places,
                                      std::span<const LeafVertices> leaves, double grade) {
  return Grader(sizes, places, leaves, grade).run();
}

}  // namespace coastmesh
