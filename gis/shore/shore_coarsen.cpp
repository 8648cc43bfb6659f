#include "gis/shore/shore_coarsen.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>

#include "core/metric.hpp"
#include "core/predicates.hpp"
#include "gis/geometry/box_tree.hpp"

namespace coastmesh {

namespace {

// Lengths are shares of the size wanted.
constexpr double kMoved = 0.25;       // how far a shore may be moved
constexpr double kMovedShort = 0.45;  // if segments are shorter than kShort
constexpr double kShort = 0.55;
constexpr double kLong = 1.1;            // longer segments are made only if the shore is straight:
constexpr double kStraight = 0.03;       // at most this far off them,
constexpr double kAlmostStraight = 0.1;  // or this, if segments are shorter than kShort: more would remove corners
constexpr double kNothing = 1e-9;        // rounding of points on a straight line
constexpr double kOpenMoved = 0.01;      // open boundaries
constexpr double kApart = 0.5;           // shores do not come nearer to one another
constexpr double kThinned = 0.5;         // of its width: what land narrower than that keeps when it has to give way
constexpr double kNearAlong = 1.6;       // along the shore: nearer vertices count as the same piece
constexpr double kLeastAngle = std::numbers::pi / 4;

class Coarsener {
 public:
  Coarsener(ShoreChains& chains, const ShoreLoss& gone) : c_(chains), gone_(gone) {
    version_.assign(c_.at.size(), 0);
    dropped_.resize(c_.at.size());
    for (VertexId v = 0; v < c_.at.size(); ++v)
      if (c_.alive[v]) held_.push_back(v);
    plant();
  }

  void run() {
    coarsen();
    // Land that stays though narrow keeps its shores as they are: they would come nearer to each other. Triangles in
    // the water do not mind narrow land, but short segments.
    thins_land_ = true;
    coarsen();
  }

 private:
  void coarsen() {
    for (VertexId v = 0; v < c_.at.size(); ++v) enqueue(v);
    // Terminates: only removing a vertex adds entries.
    while (!queue_.empty()) {
      const Entry entry = queue_.top();
      queue_.pop();
      const VertexId v = entry.vertex;
      if (entry.version != version_[v] || !canTakeOut(c_, v) || isBlocked(v)) continue;
      const VertexId p = c_.prev[v], q = c_.next[v];
      gone_(v);
      std::vector<VertexId>& all = dropped_[p];
      all.push_back(v);
      all.insert(all.end(), dropped_[v].begin(), dropped_[v].end());
      std::vector<VertexId>().swap(dropped_[v]);
      takeOut(c_, v);
      if (++gone_since_ > held_.size() / 2) plant();
      for (const VertexId end : {p, q}) {
        ++version_[end];
        enqueue(end);
      }
    }
  }

  // Builds the tree of remaining vertices: again whenever half are gone, as searches would find mostly removed ones.
  void plant() {
    std::erase_if(held_, [&](VertexId v) { return !c_.alive[v]; });
    std::vector<Box> boxes;
    for (const VertexId v : held_) boxes.push_back(Box::of(c_.at[v], c_.at[v]));
    tree_ = BoxTree(boxes, BoxTree::Order::Hilbert);
    gone_since_ = 0;
  }

  struct Entry {
    double cost;
    VertexId vertex;
    std::uint32_t version;
    bool operator<(const Entry& other) const { return cost != other.cost ? cost > other.cost : vertex > other.vertex; }
  };

  // The distance from v, and from vertices removed beside it, to the segment that would replace it, as a share of the
  // size at v.
  double costOf(VertexId v) const {
    const Point &a = c_.at[c_.prev[v]], &b = c_.at[c_.next[v]];
    double cost = squaredDistanceToSegment(c_.at[v], a, b);
    for (const VertexId from : {c_.prev[v], v})
      for (const VertexId d : dropped_[from]) cost = std::max(cost, squaredDistanceToSegment(c_.at[d], a, b));
    return std::sqrt(cost) / c_.size[v];
  }

  void enqueue(VertexId v) {
    if (!canTakeOut(c_, v)) return;
    const Point &a = c_.at[c_.prev[v]], &b = c_.at[c_.next[v]], &x = c_.at[v];
    const double size = c_.size[v], cost = costOf(v);
    double most = c_.open[v] ? kOpenMoved : kMoved;
    const bool is_short = !c_.open[v] && std::min(distance(a, x), distance(x, b)) < kShort * size;
    if (is_short) most = kMovedShort;
    if (thins_land_ && !is_short) return;
    if (distance(a, b) > kLong * size) most = std::min(most, is_short ? kAlmostStraight : kStraight);
    if (cost <= most) queue_.push({cost, v, version_[v]});
  }

  bool isBlocked(VertexId v) {
    const VertexId p = c_.prev[v], q = c_.next[v];
    if (makesSmallAngle(c_.prev[p], p, v, q) || makesSmallAngle(c_.next[q], q, v, p)) return true;
    const Point &a = c_.at[p], &x = c_.at[v], &b = c_.at[q];
    const int turn = orient2d(a, x, b);
    Box box = Box::of(a, b);
    box.add(x);
    bool found = false;
    // On a straight shore, nothing comes nearer.
    const double reach = costOf(v) < kNothing ? 0.0 : kApart * c_.size[v];
    if (reach > 0.0) findNear(v);
    const Box around = box.grownBy(reach);
    const auto enter = [&](const Box& node, std::size_t, std::size_t) { return !found && node.meets(around); };
    tree_.descend(enter, [&](std::uint32_t item) {
      const VertexId w = held_[item];
      if (found || w == v || w == p || w == q || !c_.alive[w]) return;
      const Point& y = c_.at[w];
      found = turn == 0
                  ? orient2d(a, b, y) == 0 && Box::of(a, b).meets(Box::of(y, y))
                  : orient2d(a, x, y) * turn >= 0 && orient2d(x, b, y) * turn >= 0 && orient2d(b, a, y) * turn >= 0;
      if (found || reach == 0.0 || std::ranges::find(near_, w) != near_.end()) return;
      const double apart = squaredDistanceToSegment(y, a, b), least = kApart * c_.size[w];
      if (apart >= least * least) return;
      const double before = std::min(squaredDistanceToSegment(y, a, x), squaredDistanceToSegment(y, x, b));
      const bool gives_way = thins_land_ && turn < 0;  // the shore moves towards the land
      found = apart < (gives_way ? kThinned * kThinned : 1.0) * before;
    });
    return found;
  }

  // True if the water's angle at `at`, between its neighbours `beyond` and `from`, becomes small, and smaller than it
  // is, if `to` replaces `from`.
  bool makesSmallAngle(VertexId beyond, VertexId at, VertexId from, VertexId to) const {
    if (beyond == kNone) return false;
    const bool forwards = c_.next[at] == from;
    const Point aside = c_.at[to] - c_.at[at], away = c_.at[beyond] - c_.at[at];
    if (dot(aside, away) < (1.0 - kNothing) * std::abs(cross(aside, away))) return false;  // clearly above 45 degrees
    const auto angle = [&](VertexId w) {
      return forwards ? waterAngle(c_.at[beyond], c_.at[at], c_.at[w]) : waterAngle(c_.at[w], c_.at[at], c_.at[beyond]);
    };
    const double then = angle(to);
    return then < kLeastAngle && then < angle(from);
  }

  // Collects vertices of the same piece of shore as v.
  void findNear(VertexId v) {
    near_.clear();
    const double reach = kNearAlong * c_.size[v];
    double way = 0.0;
    for (VertexId w = c_.prev[v]; w != kNone && way <= reach && w != v; w = c_.prev[w]) {
      near_.push_back(w);
      if (c_.prev[w] != kNone) way += distance(c_.at[w], c_.at[c_.prev[w]]);
    }
    way = 0.0;
    for (VertexId w = c_.next[v]; w != kNone && way <= reach && w != v; w = c_.next[w]) {
      near_.push_back(w);
      if (c_.next[w] != kNone) way += distance(c_.at[w], c_.at[c_.next[w]]);
    }
  }

  ShoreChains& c_;
  const ShoreLoss& gone_;
  std::vector<std::uint32_t> version_;
  std::vector<std::vector<VertexId>> dropped_;  // for each vertex: those removed along the segment to the next
  std::vector<VertexId> near_;
  std::vector<VertexId> held_;  // vertices in the tree
  std::size_t gone_since_ = 0;
  bool thins_land_ = false;
  BoxTree tree_;
  std::priority_queue<Entry> queue_;
};

}  // namespace

void coarsenShores(ShoreChains& chains, const ShoreLoss& gone) { Coarsener(chains, gone).run(); }

}  // namespace coastmesh
