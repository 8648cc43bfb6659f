#include "gis/clean_touches.hpp"

#include <algorithm>
#include <cmath>

#include "core/predicates.hpp"
#include "gis/box_tree.hpp"

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
  Toucher(const std::vector<TouchChain>& chains, double widest) : chains_(chains), widest_(widest) {
    for (std::uint32_t c = 0; c < chains.size(); ++c) {
      const std::size_t n = chains[c].points->size(), edges = chains[c].closed || n == 0 ? n : n - 1;
      for (std::uint32_t i = 0; i < edges; ++i) edges_.push_back({c, i});
    }
  }

  std::vector<Insertion> find() {
    std::vector<Box> boxes;
    boxes.reserve(edges_.size());
    for (const ChainEdge& edge : edges_) boxes.push_back(Box::of(start(edge), end(edge)));
    const BoxTree tree(boxes, BoxTree::Order::Hilbert);
    for (std::uint32_t e = 0; e < edges_.size(); ++e) {
      tree.visit(boxes[e], [&](std::uint32_t f) {
        if (f == e) return;
        // Every point is the start of one edge, but for the last of an open line.
        test(edges_[e], boxes[e], start(edges_[f]));
        test(edges_[e], boxes[e], end(edges_[f]));
      });
    }
    std::sort(found_.begin(), found_.end());
    const auto same = [](const Insertion& p, const Insertion& q) { return !(p < q) && !(q < p); };
    found_.erase(std::unique(found_.begin(), found_.end(), same), found_.end());
    return std::move(found_);
  }

 private:
  const Point& start(const ChainEdge& edge) const { return (*chains_[edge.chain].points)[edge.index]; }
  const Point& end(const ChainEdge& edge) const {
    const auto& points = *chains_[edge.chain].points;
    return points[(edge.index + 1) % points.size()];
  }

  void test(const ChainEdge& edge, const Box& box, const Point& p) {
    const Point &a = start(edge), &b = end(edge);
    if (box.xmax - box.xmin > widest_ || p == a || p == b || !box.meets({p.x, p.y, p.x, p.y}) || orient2d(a, b, p) != 0)
      return;
    const bool by_x = box.xmax - box.xmin >= box.ymax - box.ymin;
    found_.push_back({edge, by_x ? std::abs(p.x - a.x) : std::abs(p.y - a.y), p});
  }

  const std::vector<TouchChain>& chains_;
  double widest_;
  std::vector<ChainEdge> edges_;
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
