#include "gis/coast/line_network.hpp"

#include <algorithm>
#include <cassert>

#include "core/ids.hpp"
#include "core/predicates.hpp"
#include "core/union_find.hpp"

namespace coastmesh {

namespace {

// An arc with a direction: 2·arc leaves `from`, 2·arc + 1 leaves `to`.
using HalfArc = std::uint32_t;

HalfArc twin(HalfArc h) { return h ^ 1u; }

class Network {
 public:
  Network(const std::vector<Arc>& arcs, std::uint32_t node_count)
      : arcs_(arcs), leaving_(node_count), alive_(arcs.size(), 1), left_(arcs.size()), mark_(node_count, kNone) {
    for (HalfArc h = 0; h < 2 * arcs.size(); ++h) leaving_[tail(h)].push_back(h);
    for (auto& star : leaving_) sortAround(star);
  }

  PeeledNetwork peel() {
    // Each pass removes at least one arc.
    while (left_ > 0) {
      pruneBlindEnds();
      for (const HalfArc h : outerHalfArcs()) splitIntoRings(walkFace(h));
    }
    return std::move(result_);
  }

 private:
  std::uint32_t tail(HalfArc h) const { return h % 2 == 0 ? arcs_[h / 2].from : arcs_[h / 2].to; }
  std::uint32_t head(HalfArc h) const { return tail(twin(h)); }
  const Point& tailPoint(HalfArc h) const {
    return h % 2 == 0 ? arcs_[h / 2].points.front() : arcs_[h / 2].points.back();
  }
  const Point& secondPoint(HalfArc h) const {
    const auto& points = arcs_[h / 2].points;
    return h % 2 == 0 ? points[1] : points[points.size() - 2];
  }

  // Counter-clockwise, beginning due east.
  void sortAround(std::vector<HalfArc>& star) const {
    const auto lower = [&](HalfArc h) {
      const Point &v = tailPoint(h), &p = secondPoint(h);
      return p.y < v.y || (p.y == v.y && p.x < v.x);
    };
    std::sort(star.begin(), star.end(), [&](HalfArc g, HalfArc h) {
      if (lower(g) != lower(h)) return lower(h);
      const int turn = orient2d(tailPoint(g), secondPoint(g), secondPoint(h));
      return turn != 0 ? turn > 0 : g < h;
    });
  }

  void take(std::uint32_t arc) {
    assert(alive_[arc]);
    alive_[arc] = 0;
    --left_;
    for (const HalfArc h : {2 * arc, 2 * arc + 1}) std::erase(leaving_[tail(h)], h);
  }

  void pruneBlindEnds() {
    std::vector<std::uint32_t> blind;
    for (std::uint32_t node = 0; node < leaving_.size(); ++node) {
      if (leaving_[node].size() == 1) blind.push_back(node);
    }
    while (!blind.empty()) {
      const std::uint32_t node = blind.back();
      blind.pop_back();
      if (leaving_[node].size() != 1) continue;
      const HalfArc h = leaving_[node].front();
      const std::uint32_t other = head(h);
      take(h / 2);
      result_.open.push_back(h / 2);
      if (leaving_[other].size() == 1) blind.push_back(other);
    }
  }

  // For each connected piece, a half-arc with the unbounded face on its left.
  std::vector<HalfArc> outerHalfArcs() const {
    UnionFind pieces(leaving_.size());
    for (std::uint32_t a = 0; a < arcs_.size(); ++a) {
      if (alive_[a]) pieces.unite(arcs_[a].from, arcs_[a].to);
    }
    // The least vertex (by x, then y) of each piece lies on its outer boundary. If it is an end of arcs, a half-arc
    // that leaves it has the unbounded face on its left.
    struct Least {
      std::uint32_t arc = kNone;
      std::size_t vertex = 0;
    };
    std::vector<Least> least(leaving_.size());
    for (std::uint32_t a = 0; a < arcs_.size(); ++a) {
      if (!alive_[a]) continue;
      Least& best = least[pieces.find(arcs_[a].from)];
      for (std::size_t i = 0; i < arcs_[a].points.size(); ++i) {
        if (best.arc == kNone || lexLess(arcs_[a].points[i], arcs_[best.arc].points[best.vertex])) best = {a, i};
      }
    }
    std::vector<HalfArc> outer;
    for (const Least& at : least) {
      if (at.arc != kNone) outer.push_back(outerAt(at.arc, at.vertex));
    }
    return outer;
  }

  HalfArc outerAt(std::uint32_t arc, std::size_t vertex) const {
    const auto& points = arcs_[arc].points;
    if (vertex > 0 && vertex + 1 < points.size()) {
      const bool left_turn = orient2d(points[vertex - 1], points[vertex], points[vertex + 1]) > 0;
      return 2 * arc + (left_turn ? 1 : 0);
    }
    // All half-arcs leave the least vertex between due south (exclusive) and due north: the unbounded face is on the
    // left of the last of them.
    const auto& star = leaving_[vertex == 0 ? arcs_[arc].from : arcs_[arc].to];
    HalfArc last = star.front();
    for (const HalfArc h : star) {
      if (orient2d(tailPoint(last), secondPoint(last), secondPoint(h)) > 0) last = h;
    }
    return last;
  }

  // The half-arcs around the face on the left of `first`.
  std::vector<HalfArc> walkFace(HalfArc first) const {
    std::vector<HalfArc> walk;
    HalfArc h = first;
    do {
      walk.push_back(h);
      const auto& star = leaving_[head(h)];
      const auto at = std::find(star.begin(), star.end(), twin(h));
      h = at == star.begin() ? star.back() : *(at - 1);
    } while (h != first);
    return walk;
  }

  // Cuts the walk where it returns to a node; a piece out and back along one arc is a bridge.
  void splitIntoRings(const std::vector<HalfArc>& walk) {
    std::vector<HalfArc> stack;
    for (const HalfArc h : walk) {
      mark_[tail(h)] = static_cast<std::uint32_t>(stack.size());
      stack.push_back(h);
      if (mark_[head(h)] == kNone) continue;
      const std::size_t begin = mark_[head(h)];
      std::vector<HalfArc> loop(stack.begin() + static_cast<std::ptrdiff_t>(begin), stack.end());
      stack.resize(begin);
      for (const HalfArc used : loop) mark_[tail(used)] = kNone;
      // If a line is present twice, the walk returns along the other side of arcs that are already taken.
      if (std::ranges::any_of(loop, [&](HalfArc used) { return alive_[used / 2] == 0; })) continue;
      if (loop.size() == 2 && loop[0] == twin(loop[1])) {
        result_.open.push_back(loop[0] / 2);
        take(loop[0] / 2);
        continue;
      }
      auto& ring = result_.rings.emplace_back();
      for (const HalfArc used : loop) {
        ring.push_back({used / 2, used % 2 == 1});
        take(used / 2);
      }
    }
    assert(stack.empty());
  }

  const std::vector<Arc>& arcs_;
  std::vector<std::vector<HalfArc>> leaving_;  // living half-arcs by node, counter-clockwise
  std::vector<char> alive_;
  std::size_t left_;
  std::vector<std::uint32_t> mark_;  // by node: its place in the stack of `splitIntoRings`, else kNone
  PeeledNetwork result_;
};

}  // namespace

PeeledNetwork peelNetwork(const std::vector<Arc>& arcs, std::uint32_t node_count) {
  return Network(arcs, node_count).peel();
}

}  // namespace coastmesh
