#include "gis/clean_touches.hpp"

#include <algorithm>
#include <cmath>

#include "core/predicates.hpp"
#include "gis/edge_runs.hpp"

namespace coastmesh {

namespace {

struct ChainEdge {
  std::uint32_t chain;
  std::uint32_t index;  // of its first point
};

struct Insertion {
  ChainEdge edge;
  double along;  // distance from the edge's first point, by its longer coordinate
  Point place;

  friend bool operator<(const Insertion& p, const Insertion& q) {
    if (p.edge.chain != q.edge.chain) return p.edge.chain < q.edge.chain;
    return p.edge.index != q.edge.index ? p.edge.index < q.edge.index : p.along < q.along;
  }
};

class Toucher {
 public:
  Toucher(const std::vector<TouchChain>& chains, double widest) : widest_(widest) {
    std::size_t count = 0;
    for (const TouchChain& chain : chains) count += chain.points->size();
    ends_.reserve(count);
    edges_.reserve(count);
    for (std::uint32_t c = 0; c < chains.size(); ++c) {
      const std::vector<Point>& points = *chains[c].points;
      for (std::uint32_t i = 0; i + 1 < points.size(); ++i) addEdge({c, i}, points[i], points[i + 1]);
      if (chains[c].closed && !points.empty()) {
        addEdge({c, static_cast<std::uint32_t>(points.size() - 1)}, points.back(), points.front());
      }
    }
  }

  std::vector<Insertion> find() {
    const auto box_of = [&](std::size_t e) { return Box::of(ends_[e].a, ends_[e].b); };
    const auto all = [](std::uint32_t) { return true; };
    const EdgeRuns runs(ends_.size(), box_of);
    runs.visitPairs(0, runs.runCount(), 0, box_of, all, [&](std::uint32_t e, std::uint32_t f) {
      test(e, ends_[f].a);
      test(e, ends_[f].b);
      test(f, ends_[e].a);
      test(f, ends_[e].b);
    });
    std::sort(found_.begin(), found_.end());
    const auto same = [](const Insertion& p, const Insertion& q) { return !(p < q) && !(q < p); };
    found_.erase(std::unique(found_.begin(), found_.end(), same), found_.end());
    return std::move(found_);
  }

 private:
  struct Ends {
    Point a, b;
  };

  void addEdge(const ChainEdge& edge, const Point& a, const Point& b) {
    edges_.push_back(edge);
    ends_.push_back({a, b});
  }

  void test(std::uint32_t e, const Point& p) {
    const auto& [a, b] = ends_[e];
    const Box box = Box::of(a, b);
    if (!box.meets({p.x, p.y, p.x, p.y}) || p == a || p == b || box.xmax - box.xmin > widest_ || orient2d(a, b, p) != 0)
      return;
    const bool by_x = box.xmax - box.xmin >= box.ymax - box.ymin;
    found_.push_back({edges_[e], by_x ? std::abs(p.x - a.x) : std::abs(p.y - a.y), p});
  }

  double widest_;
  std::vector<ChainEdge> edges_;
  std::vector<Ends> ends_;
  std::vector<Insertion> found_;
};

}  // namespace

std::vector<Touch> insertTouchingPoints(const std::vector<TouchChain>& chains, double widest) {
  const std::vector<Insertion> insertions = Toucher(chains, widest).find();
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
