#include "gis/clean/clean_touches.hpp"

#include <algorithm>
#include <cmath>

#include "core/predicates.hpp"
#include "gis/geometry/edge_runs.hpp"

namespace coastmesh {

namespace {

struct ChainEdge {
  std::uint32_t chain;
  std::uint32_t index;  // of its first point
};

struct Insertion {
  ChainEdge edge;
  double along;  // distance from the edge's first point, along its longer coordinate
  Point place;

  friend bool operator<(const Insertion& p, const Insertion& q) {
    if (p.edge.chain != q.edge.chain) return p.edge.chain < q.edge.chain;
    return p.edge.index != q.edge.index ? p.edge.index < q.edge.index : p.along < q.along;
  }
};

class Toucher {
 public:
  Toucher(const std::vector<TouchChain>& chains, double tolerance, double widest)
      : tolerance_(tolerance), widest_(widest) {
    std::size_t count = 0;
    for (const TouchChain& chain : chains) count += chain.points->size();
    ends_.reserve(count);
    first_edge_.reserve(chains.size());
    for (const TouchChain& chain : chains) {
      const std::vector<Point>& points = *chain.points;
      first_edge_.push_back(static_cast<std::uint32_t>(ends_.size()));
      for (std::size_t i = 0; i + 1 < points.size(); ++i) ends_.push_back({points[i], points[i + 1]});
      // A single point is an edge without length, so that it is found near others.
      if (!points.empty() && (chain.closed || points.size() == 1)) ends_.push_back({points.back(), points.front()});
    }
    double largest = 0;
    for (const auto& [a, b] : ends_) largest = std::max({largest, std::abs(a.x), std::abs(a.y)});
    // A point put on an edge is rounded by half a unit in the last place, and so are both ends of the edge.
    tolerance_ = std::max(tolerance_, std::ldexp(largest, -51));
  }

  std::vector<Insertion> find(const ItemLoop& loop) {
    const auto box_of = [&](std::size_t e) { return Box::of(ends_[e].a, ends_[e].b); };
    const auto all = [](std::uint32_t) { return true; };
    const EdgeRuns runs(ends_.size(), box_of);
    const auto findIn = [&](std::size_t first, std::size_t last) {
      std::vector<Insertion> found;
      runs.visitPairs(first, last, tolerance_, box_of, all, [&](std::uint32_t e, std::uint32_t f) {
        test(e, ends_[f].a, found);
        test(e, ends_[f].b, found);
        test(f, ends_[e].a, found);
        test(f, ends_[e].b, found);
      });
      return found;
    };
    std::vector<Insertion> found = joined(overStretches(loop, runs.blockCount(), findIn, EdgeRuns::kWorthAStretch));
    std::sort(found.begin(), found.end());
    const auto same = [](const Insertion& p, const Insertion& q) { return !(p < q) && !(q < p); };
    found.erase(std::unique(found.begin(), found.end(), same), found.end());
    return found;
  }

 private:
  struct Ends {
    Point a, b;
  };

  ChainEdge edgeOf(std::uint32_t e) const {
    const auto chain = std::ranges::upper_bound(first_edge_, e) - first_edge_.begin() - 1;
    return {static_cast<std::uint32_t>(chain), e - first_edge_[static_cast<std::size_t>(chain)]};
  }

  void test(std::uint32_t e, const Point& p, std::vector<Insertion>& found) const {
    const auto& [a, b] = ends_[e];
    const Box box = Box::of(a, b);
    if (!box.grownBy(tolerance_).meets({p.x, p.y, p.x, p.y}) || p == a || p == b || box.xmax - box.xmin > widest_)
      return;
    const double dx = b.x - a.x, dy = b.y - a.y, wx = p.x - a.x, wy = p.y - a.y, length = std::sqrt(dx * dx + dy * dy);
    const double along = wx * dx + wy * dy, most = tolerance_ * length;
    const bool near = along > most && along < length * length - most && std::abs(wx * dy - wy * dx) <= most;
    if (!near && !(box.meets({p.x, p.y, p.x, p.y}) && orient2d(a, b, p) == 0)) return;
    const bool by_x = box.xmax - box.xmin >= box.ymax - box.ymin;
    found.push_back({edgeOf(e), by_x ? std::abs(p.x - a.x) : std::abs(p.y - a.y), p});
  }

  double tolerance_, widest_;
  std::vector<std::uint32_t> first_edge_;  // by chain
  std::vector<Ends> ends_;
};

}  // namespace

std::vector<Touch> insertTouchingPoints(const std::vector<TouchChain>& chains, double tolerance, double widest,
                                        const ItemLoop& loop) {
  const std::vector<Insertion> insertions = Toucher(chains, tolerance, widest).find(loop);
  std::vector<Touch> touches;
  for (auto first = insertions.begin(); first != insertions.end();) {
    const std::uint32_t chain = first->edge.chain;
    std::vector<Point> with;
    const std::vector<Point>& without = *chains[chain].points;
    auto next = first;
    for (std::uint32_t i = 0; i < without.size(); ++i) {
      with.push_back(without[i]);
      for (; next != insertions.end() && next->edge.chain == chain && next->edge.index == i; ++next) {
        with.push_back(next->place);
        touches.push_back({chain, next->place});
      }
    }
    *chains[chain].points = std::move(with);
    first = next;
  }
  return touches;
}

}  // namespace coastmesh
