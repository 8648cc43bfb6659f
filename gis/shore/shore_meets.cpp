#include "gis/shore/shore_meets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/metric.hpp"
#include "core/predicates.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/shore/shore_divide.hpp"
#include "gis/shore/shore_pieces.hpp"

namespace coastmesh {

namespace {

// Lengths are shares of the size wanted.
constexpr double kMet = 0.25;                    // farther points are left to mending, which lets the shore recede
constexpr double kAtVertex = 0.25;               // a foot this near to a vertex uses that
constexpr double kLeastAngle = toRadians(30.0);  // between a line and the shore
constexpr int kRounds = 12;

class Meeter {
 public:
  Meeter(ShoreChains& chains, const ShoreMeet& met) : c_(chains), met_(met), near_(chains) {}

  void run() {
    plan();
    for (const Meeting& meeting : planned_) divideBeside(c_, meeting.on_shore);
    for (int round = 0; round < kRounds && !planned_.empty(); ++round) meetOnce();
  }

 private:
  struct Foot {
    VertexId in_water, after;  // nearest to the segment that leaves `after`
    double along = 0.0;
  };
  struct Meeting {
    VertexId on_shore, in_water;
  };

  bool isShore(VertexId v) const { return c_.alive[v] && c_.next[v] != kNone && c_.leaving[v].tag != kOpenTag; }
  bool isFixed(VertexId v) const { return c_.stays[v] != 0 || c_.open[v] != 0; }

  void plan() {
    const std::size_t count = c_.at.size();
    std::vector<std::uint8_t> lines(count, 0);
    beyond_.assign(count, kNone);
    for (const Segment& s : c_.lines) {
      for (const VertexId v : {s.a, s.b})
        if (lines[v] < 2) ++lines[v];
      beyond_[s.a] = s.b;
      beyond_[s.b] = s.a;
    }
    std::vector<VertexId> segments;
    std::vector<Box> boxes;
    for (VertexId v = 0; v < count; ++v) {
      if (!c_.alive[v] || c_.next[v] == kNone) continue;
      segments.push_back(v);
      boxes.push_back(Box::of(c_.at[v], c_.at[c_.next[v]]));
    }
    if (boxes.empty()) return;
    std::optional<BoxTree> tree;
    std::vector<Foot> feet;
    for (VertexId w = 0; w < count; ++w) {
      if (!c_.alive[w] || c_.next[w] != kNone || c_.prev[w] != kNone || lines[w] > 1) continue;
      if (!tree) tree.emplace(boxes, BoxTree::Order::Hilbert);
      addFoot(w, *tree, segments, feet);
    }
    std::ranges::sort(feet, [](const Foot& a, const Foot& b) {
      return a.after != b.after ? a.after < b.after : a.along != b.along ? a.along < b.along : a.in_water < b.in_water;
    });
    std::vector<char> is_taken(count, 0);
    VertexId last = kNone;
    for (std::size_t i = 0; i < feet.size(); ++i) {
      if (i == 0 || feet[i].after != feet[i - 1].after) last = feet[i].after;
      addMeeting(feet[i], is_taken, last);
    }
  }

  void addFoot(VertexId w, const BoxTree& tree, const std::vector<VertexId>& segments, std::vector<Foot>& feet) const {
    const Point& x = c_.at[w];
    const double most = kMet * c_.size[w];
    double least = std::numeric_limits<double>::infinity();
    VertexId nearest = kNone;
    tree.visit(Box::of(x, x).grownBy(most), [&](std::uint32_t item) {
      const VertexId v = segments[item];
      const double off = squaredDistanceToSegment(x, c_.at[v], c_.at[c_.next[v]]);
      if (off > least || (off == least && nearest < v)) return;
      least = off;
      nearest = v;
    });
    if (nearest == kNone || least > most * most || !isShore(nearest)) return;
    const Point &a = c_.at[nearest], &b = c_.at[c_.next[nearest]];
    feet.push_back({w, nearest, std::clamp(dot(x - a, b - a) / std::sqrt(squaredDistance(a, b)), 0.0, distance(a, b))});
  }

  // `last`: the vertex before the foot.
  void addMeeting(const Foot& foot, std::vector<char>& is_taken, VertexId& last) {
    const VertexId w = foot.in_water, after = c_.next[last];
    const Point &a = c_.at[foot.after], &x = c_.at[w];
    const double size = c_.size[w], before = foot.along - distance(a, c_.at[last]);
    const double left = distance(a, c_.at[after]) - foot.along;
    const VertexId nearest = before <= left ? last : after;
    if (std::min(before, left) <= kAtVertex * size) {
      if (isFixed(nearest) || is_taken[nearest] || distance(c_.at[nearest], x) > kMet * size) return;
      is_taken[nearest] = 1;
      planned_.push_back({nearest, w});
      return;
    }
    const Point& b = c_.at[after];
    last = cutAfter(c_, last, a + foot.along / distance(a, b) * (b - a), size);
    is_taken.push_back(1);
    planned_.push_back({last, w});
  }

  void meetOnce() {
    near_.buildTrees();
    std::vector<char> locked(c_.at.size(), 0);
    std::vector<Meeting> later;
    for (const Meeting& meeting : planned_) {
      near_.gather(meeting.on_shore, kMet);
      if (std::ranges::any_of(near_.points(), [&](VertexId v) { return locked[v] != 0; })) {
        later.push_back(meeting);
        continue;
      }
      if (!canMeet(meeting)) continue;
      for (const VertexId v : near_.points()) locked[v] = 1;
      locked[meeting.in_water] = 1;
      meet(meeting);
    }
    planned_ = std::move(later);
  }

  bool canMeet(const Meeting& meeting) const {
    const auto& [v, w] = meeting;
    const VertexId p = c_.prev[v], q = c_.next[v];
    const Point &a = c_.at[p], &b = c_.at[q], &x = c_.at[w];
    if (c_.next[q] == p || !near_.canMove(v, x, w)) return false;
    const VertexId u = beyond_[w];
    if (u == kNone) return true;
    const double before = waterAngle(a, x, c_.at[u]), after = waterAngle(c_.at[u], x, b);
    return before >= kLeastAngle && after >= kLeastAngle && before + after < waterAngle(a, x, b) + kLeastAngle;
  }

  void meet(const Meeting& meeting) {
    const auto& [v, w] = meeting;
    met_(v, w);
    const VertexId p = c_.prev[v], q = c_.next[v];
    c_.next[p] = c_.prev[q] = w;
    c_.prev[w] = p;
    c_.next[w] = q;
    c_.leaving[w] = c_.leaving[v];
    drop(c_, v);
  }

  ShoreChains& c_;
  const ShoreMeet& met_;
  ShorePieces near_;
  std::vector<VertexId> beyond_;  // of the end of a segment of a line: its other end
  std::vector<Meeting> planned_;
};

}  // namespace

void meetPoints(ShoreChains& chains, const ShoreMeet& met) { Meeter(chains, met).run(); }

}  // namespace coastmesh
