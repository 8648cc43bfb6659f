#include "gis/shore/shore_thin.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include "core/metric.hpp"
#include "gis/coast/segment_tags.hpp"

namespace coastmesh {

namespace {

// Shares of the size wanted.
constexpr double kMoved = 0.1;
constexpr double kLongest = 0.6;
constexpr double kNearAlong = 1.6;  // along the shore: nearer vertices count as the same piece
constexpr double kMovedOfWidth = 0.2;
constexpr double kLongestIsland = 3.0;
const double kTriangle = 0.25 * std::sqrt(3.0);  // area of one of side 1
constexpr double kGrain = 1e-12;                 // of coordinates: a point this near to a line may lie on it

class Thinner {
 public:
  Thinner(ShoreChains& chains, const ShoreThinning& thinning, const ShoreLoss& gone, const ItemLoop& loop)
      : c_(chains), thinning_(thinning), gone_(gone), loop_(loop) {}

  void run() {
    layOut();
    std::vector<Run> runs;
    for (std::uint32_t s = 0; s < stretches_.size(); ++s) cutIntoRuns(s, runs);
    indexRuns(runs);
    for (std::uint32_t s = 0; s < stretches_.size(); ++s)
      if (isSmallIsland(stretches_[s])) stretches_[s].is_gone = true;
    for (const Stretch& stretch : stretches_) {
      if (!stretch.is_gone) continue;
      thinning_.dropped(order_[stretch.first], islandArea(stretch));
      for (std::uint32_t i = stretch.first; i < stretch.last; ++i) drop(c_, order_[i]);
    }
    // Each run is judged by the original shore.
    const std::vector<Run> leaving = joined(overStretches(
        loop_, runs.size(),
        [&](std::size_t first, std::size_t last) { return freeOf(std::span(runs).subspan(first, last - first)); },
        kStretch));
    for (const Run& run : leaving) {
      for (std::uint32_t i = run.first + 1; i < run.last; ++i) {
        gone_(order_[i]);
        takeOut(c_, order_[i]);
      }
    }
  }

 private:
  // Vertices between two that stay, or a ring, whose first vertex is also the last.
  struct Stretch {
    std::uint32_t first, last;  // places in `order_`
    bool is_ring;
    bool is_gone = false;
  };
  struct Run {
    std::uint32_t first, last;
    std::uint32_t stretch;
    double off = 0.0;  // distance from its segment, once measured
  };
  static constexpr std::size_t kStretch = 2048;  // runs per task

  const Point& at(std::uint32_t place) const { return c_.at[order_[place]]; }
  double sizeAt(std::uint32_t place) const { return c_.size[order_[place]]; }
  double sizeBefore(std::uint32_t place) const { return thinning_.before ? thinning_.before->at(at(place)) : 0.0; }
  bool isShore(VertexId v) const { return c_.next[v] != kNone && c_.leaving[v].tag != kOpenTag; }
  bool isInner(VertexId v) const {  // between two segments of the same shore
    return !c_.stays[v] && c_.prev[v] != kNone && isShore(v) && c_.leaving[c_.prev[v]].tag != kOpenTag;
  }

  void layOut() {
    std::vector<bool> seen(c_.at.size(), false);
    const auto walk = [&](VertexId start) {
      const auto first = static_cast<std::uint32_t>(order_.size());
      double way = 0.0;
      VertexId v = start;
      do {
        order_.push_back(v);
        way_.push_back(way);
        seen[v] = true;
        way += distance(c_.at[v], c_.at[c_.next[v]]);
        v = c_.next[v];
      } while (v != start && isInner(v));
      order_.push_back(v);
      way_.push_back(way);
      seen[v] = true;
      stretches_.push_back({first, static_cast<std::uint32_t>(order_.size() - 1), v == start && isInner(v)});
    };
    for (VertexId v = 0; v < seen.size(); ++v)
      if (isShore(v) && !isInner(v)) walk(v);
    for (VertexId v = 0; v < seen.size(); ++v)
      if (isShore(v) && !seen[v]) walk(v);
    for (VertexId v = 0; v < seen.size(); ++v)
      if (c_.alive[v] && !seen[v]) others_.push_back(v);
  }

  // Extends each run while all of it lies near enough to the line from its first vertex to its last: within the range
  // of directions that this allows.
  void cutIntoRuns(std::uint32_t s, std::vector<Run>& runs) const {
    const Stretch& stretch = stretches_[s];
    // A third of the stretch: a ring keeps three vertices, and a stretch remains distinct from others with the same
    // ends.
    const std::uint32_t most = std::max(1u, (stretch.last - stretch.first) / 3);
    for (std::uint32_t i = stretch.first; i < stretch.last;) {
      const Point& a = at(i);
      const double size = sizeAt(i), before = sizeBefore(i), off = kMoved * std::max(0.0, size - before);
      const double longest = size >= kMuchMore * before ? kLongest * size : 0.0;
      std::uint32_t end = i + 1;
      double farthest = 0.0;
      bool is_open = true;  // all directions are allowed
      Point low, high;      // else those to the left of `low` and to the right of `high`
      for (std::uint32_t j = i + 1; j <= std::min(stretch.last, i + most); ++j) {
        const Point d = at(j) - a;
        const double far = std::sqrt(squaredLength(d));
        if (far > longest) break;
        if (is_open || (cross(low, d) >= 0.0 && cross(d, high) >= 0.0)) {
          if (far >= farthest - off) end = j;
        } else {
          break;
        }
        farthest = std::max(farthest, far);
        if (far <= off) continue;
        const double sine = off / far, cosine = std::sqrt(1.0 - sine * sine);
        const Point right{d.x * cosine + d.y * sine, d.y * cosine - d.x * sine};
        const Point left{d.x * cosine - d.y * sine, d.y * cosine + d.x * sine};
        if (is_open || cross(low, right) > 0.0) low = right;
        if (is_open || cross(left, high) > 0.0) high = left;
        is_open = false;
      }
      runs.push_back({i, end, s});
      i = end;
    }
  }

  void indexRuns(const std::vector<Run>& runs) {
    std::vector<Box>& boxes = boxes_;
    for (const Run& run : runs) {
      Box& box = boxes.emplace_back();
      for (std::uint32_t i = run.first; i <= run.last; ++i) box.add(at(i));
    }
    for (const VertexId v : others_) boxes.push_back(Box::of(c_.at[v], c_.at[v]));
    runs_ = runs;
    tree_ = BoxTree(boxes, BoxTree::Order::Hilbert);
  }

  // Plane area.
  double islandArea(const Stretch& stretch) const {
    double twice = 0.0;
    for (std::uint32_t i = stretch.first; i < stretch.last; ++i)
      twice += cross(at(i) - at(stretch.first), at(i + 1) - at(stretch.first));
    return -0.5 * twice;  // the water lies to the left
  }

  // True for a small ring of land with nothing in it.
  bool isSmallIsland(const Stretch& stretch) const {
    if (!stretch.is_ring) return false;
    Box box;
    double size = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = stretch.first; i < stretch.last; ++i) {
      box.add(at(i));
      size = std::min(size, sizeAt(i));
    }
    const double area = islandArea(stretch);
    if (!(area > 0.0 && area < kTriangle * size * size)) return false;
    if (std::max(box.xmax - box.xmin, box.ymax - box.ymin) > kLongestIsland * size) return false;
    const Run whole{stretch.first, stretch.last, 0};
    bool is_empty = true;
    thinning_.lines.visit(box, [&](std::uint32_t) { is_empty = false; });
    tree_.visit(box, [&](std::uint32_t item) {
      if (!is_empty) return;
      const auto holds = [&](const Point& p) { return box.meets(Box::of(p, p)) && isBetween(p, whole); };
      if (item >= runs_.size()) {
        is_empty = !holds(c_.at[others_[item - runs_.size()]]);
        return;
      }
      const Run& run = runs_[item];
      if (run.first >= stretch.first && run.last <= stretch.last) return;
      for (std::uint32_t i = run.first; i <= run.last && is_empty; ++i) is_empty = !holds(at(i));
    });
    return is_empty;
  }

  // The runs that may become segments, and the largest such parts of the others.
  std::vector<Run> freeOf(std::span<const Run> runs) const {
    std::vector<Run> waiting, free;
    for (const Run& run : runs) {
      if (stretches_[run.stretch].is_gone) continue;
      waiting.assign(1, run);
      while (!waiting.empty()) {
        Run here = waiting.back();
        waiting.pop_back();
        if (here.last - here.first < 2) continue;
        const std::uint32_t farthest = measure(here);
        if (isFree(here)) {
          free.push_back(here);
        } else {
          waiting.push_back({here.first, farthest, here.stretch});
          waiting.push_back({farthest, here.last, here.stretch});
        }
      }
    }
    return free;
  }

  // Sets the run's distance from its segment; returns its farthest vertex.
  std::uint32_t measure(Run& run) const {
    const Point &a = at(run.first), &b = at(run.last);
    std::uint32_t farthest = run.first + 1;
    run.off = 0.0;
    for (std::uint32_t i = run.first + 1; i < run.last; ++i) {
      const double off = squaredDistanceToSegment(at(i), a, b);
      if (off <= run.off) continue;
      run.off = off;
      farthest = i;
    }
    run.off = std::sqrt(run.off);
    return farthest;
  }

  // True if the run may become its segment. REQUIRES: `measure`.
  bool isFree(const Run& run) const {
    const Point &a = at(run.first), &b = at(run.last);
    if (run.off > kMoved * (sizeAt(run.first) - sizeBefore(run.first))) return false;
    const double reach = run.off * (1.0 + 1.0 / kMovedOfWidth);
    const Box box = Box::of(a, b).grownBy(reach);
    const double hair = 2.0 * kGrain * (std::abs(a.x) + std::abs(a.y) + reach);
    const Box beside = Box::of(a, b).grownBy(run.off + hair);
    bool is_free = true;
    thinning_.lines.visit(box, [&](std::uint32_t) { is_free = false; });
    if (!is_free) return false;
    tree_.descend([&](const Box& node, std::size_t, std::size_t) { return is_free && node.meets(box); },
                  [&](std::uint32_t item) {
                    if (item >= runs_.size())
                      is_free = squaredDistanceToSegment(c_.at[others_[item - runs_.size()]], a, b) > reach * reach;
                    else
                      is_free = !(boxes_[item].meets(beside) && holdsAnyOf(runs_[item], run, beside)) &&
                                (isAllNearAlong(run, runs_[item]) || isFreeOf(run, runs_[item], box, reach));
                  });
    return is_free;
  }

  // True if a vertex of the other lies between the run and its segment; `beside` contains all that may.
  bool holdsAnyOf(const Run& other, const Run& run, const Box& beside) const {
    if (stretches_[other.stretch].is_gone) return false;
    const bool is_same = other.stretch == run.stretch;
    for (std::uint32_t i = other.first; i <= other.last; ++i) {
      if (is_same && i > run.first && i < run.last) continue;
      if (order_[i] == order_[run.first] || order_[i] == order_[run.last]) continue;
      if (beside.meets(Box::of(at(i), at(i))) && isNear(at(i), run) && isBetween(at(i), run)) return true;
    }
    return false;
  }

  // True if all of the other belongs to the same piece of shore.
  bool isAllNearAlong(const Run& run, const Run& other) const {
    if (other.stretch != run.stretch || (other.first < run.last && run.first < other.last)) return false;
    const double way =
        other.first >= run.last ? way_[other.last] - way_[run.last] : way_[run.first] - way_[other.first];
    return way <= kNearAlong * sizeAt(run.first);
  }

  // `box` contains all within `reach` of the run's segment.
  bool isFreeOf(const Run& run, const Run& other, const Box& box, double reach) const {
    if (stretches_[other.stretch].is_gone) return true;
    const bool is_same = other.stretch == run.stretch;
    for (std::uint32_t i = other.first; i < other.last; ++i) {
      if (is_same && i >= run.first && i < run.last) continue;
      if (box.meets(Box::of(at(i), at(i + 1))) && isAcrossLand(run, i) && !isNearAlong(run, other.stretch, i) &&
          isWithin(reach, at(run.first), at(run.last), at(i), at(i + 1)))
        return false;
    }
    return true;
  }

  // True if x is no farther from the segment than the run, like any point between the two.
  bool isNear(const Point& x, const Run& run) const {
    const double off = run.off + kGrain * (std::abs(x.x) + std::abs(x.y));
    return squaredDistanceToSegment(x, at(run.first), at(run.last)) <= off * off;
  }

  bool isNearAlong(const Run& run, std::uint32_t stretch, std::uint32_t i) const {
    if (stretch != run.stretch) return false;
    const double near = kNearAlong * sizeAt(run.first);
    const double way = i >= run.last ? way_[i] - way_[run.last] : way_[run.first] - way_[i + 1];
    if (way <= near) return true;
    const Stretch& whole = stretches_[stretch];
    const double round = way_[whole.last] - way_[run.last] + way_[run.first] + way_[i] - way_[i + 1];
    return whole.is_ring && round - way <= near;
  }

  // True if land lies between (both have their water to the left), or if narrow water counts too.
  bool isAcrossLand(const Run& run, std::uint32_t i) const {
    if (thinning_.keeps_narrow_water) return true;
    const Point &a = at(run.first), &b = at(run.last), &c = at(i), &d = at(i + 1);
    return std::min(cross(b - a, c - a), cross(b - a, d - a)) < 0.0;
  }

  static bool isWithin(double reach, const Point& a, const Point& b, const Point& c, const Point& d) {
    return std::min({squaredDistanceToSegment(a, c, d), squaredDistanceToSegment(b, c, d),
                     squaredDistanceToSegment(c, a, b), squaredDistanceToSegment(d, a, b)}) <= reach * reach;
  }

  // True if x may lie between the run and its segment: across the segment, they lie on both sides of x.
  bool isBetween(const Point& x, const Run& run) const {
    const Point &a = at(run.first), &b = at(run.last);
    const Point along = order_[run.first] != order_[run.last] ? b - a : Point{1.0, 0.0};
    const double length = std::sqrt(squaredLength(along));
    const double hair = kGrain * (std::abs(x.x) + std::abs(x.y) + length);
    const auto toPlane = [&](const Point& p) {
      return Point{dot(along, p - x) / length, cross(along, p - x) / length};
    };
    bool above = false, below = false;
    const auto pass = [&](const Point& p, const Point& q) {
      if (std::min(p.x, q.x) > hair || std::max(p.x, q.x) < -hair) return;
      const bool steep = std::abs(q.x - p.x) <= 4.0 * hair;
      const double y = steep ? 0.0 : p.y + (q.y - p.y) * std::clamp(-p.x / (q.x - p.x), 0.0, 1.0);
      above = above || (steep ? std::max(p.y, q.y) : y) >= -hair;
      below = below || (steep ? std::min(p.y, q.y) : y) <= hair;
    };
    const Point start = toPlane(a);
    Point before = start;
    for (std::uint32_t i = run.first + 1; i <= run.last; ++i) {
      const Point here = toPlane(at(i));
      pass(before, here);
      before = here;
    }
    pass(before, start);
    return above && below;
  }

  ShoreChains& c_;
  const ShoreThinning& thinning_;
  const ShoreLoss& gone_;
  const ItemLoop& loop_;
  std::vector<VertexId> order_;  // vertices, by stretch
  std::vector<double> way_;      // along the stretch
  std::vector<Stretch> stretches_;
  std::vector<VertexId> others_;  // vertices on no shore
  std::vector<Run> runs_;
  std::vector<Box> boxes_;
  BoxTree tree_;  // of `boxes_`: those of `runs_`, then of `others_`
};

}  // namespace

void thinShores(ShoreChains& chains, const ShoreThinning& thinning, const ShoreLoss& gone, const ItemLoop& loop) {
  Thinner(chains, thinning, gone, loop).run();
}

}  // namespace coastmesh
