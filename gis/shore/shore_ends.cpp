#include "gis/shore/shore_ends.hpp"

#include <algorithm>

#include "core/metric.hpp"
#include "core/predicates.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/geometry/box_tree.hpp"

namespace coastmesh {

namespace {

constexpr double kShort = 0.5;  // of the size wanted
constexpr double kReach = 1.0;  // how far a piece reaches from its start
constexpr double kStraight = 0.02;

bool isOpen(const ShoreChains& c, VertexId v) { return isOpenTag(c.leaving[v].tag); }

// True if the boundary changes between shore and open at v, and its water does not.
bool isEnd(const ShoreChains& c, VertexId v) {
  return c.next[v] != kNone && c.prev[v] != kNone && isOpen(c, v) != isOpen(c, c.prev[v]) &&
         c.leaving[v].left == c.leaving[c.prev[v]].left;
}

class EndMender {
 public:
  EndMender(ShoreChains& chains, const ShoreLoss& gone) : c_(chains), gone_(gone) {
    has_line_.assign(c_.at.size(), 0);
    for (const Segment& s : c_.lines) has_line_[s.a] = has_line_[s.b] = 1;
    std::vector<Box> boxes(c_.at.size());
    for (VertexId v = 0; v < boxes.size(); ++v) boxes[v].add(c_.at[v]);
    tree_ = BoxTree(boxes, BoxTree::Order::Hilbert);
  }

  void run() {
    for (VertexId v = 0; v < c_.at.size(); ++v)
      if (c_.alive[v] && isEnd(c_, v) && walk(v) && distance(c_.at[v], c_.at[way_.back()]) < kShort * c_.size[v])
        isOpen(c_, v) ? closePiece() : openPiece();
  }

 private:
  // Follows the piece that begins at v to its other end; false if that is far away or something is in between.
  bool walk(VertexId v) {
    way_.assign(1, v);
    for (VertexId w = c_.next[v]; w != kNone && w != v; w = c_.next[w]) {
      way_.push_back(w);
      if (has_line_[w] || distance(c_.at[v], c_.at[w]) > kReach * c_.size[v]) return false;
      if (isEnd(c_, w)) return !has_line_[v];
      if (c_.next[w] != kNone && c_.leaving[w].left != c_.leaving[v].left) return false;
    }
    return false;
  }

  void closePiece() {
    for (std::size_t i = 0; i + 1 < way_.size(); ++i) {
      if (i > 0 && c_.stays[way_[i]]) return;
    }
    for (std::size_t i = 0; i + 1 < way_.size(); ++i) {
      c_.leaving[way_[i]].tag = 0;
      c_.stays[way_[i]] = c_.open[way_[i]] = 0;
    }
    c_.stays[way_.back()] = 0;
  }

  void openPiece() {
    const VertexId first = way_.front(), last = way_.back();
    const Point &a = c_.at[c_.prev[first]], &b = c_.at[c_.next[last]];
    for (const VertexId v : {first, last}) {
      const double most = kStraight * c_.size[v];
      if (squaredDistanceToSegment(c_.at[v], a, b) > most * most) return;
    }
    if (c_.next[c_.next[last]] == first || c_.next[last] == first) return;
    Box box;
    for (const VertexId v : way_) box.add(c_.at[v]);
    bool empty = true;
    tree_.visit(box,
                [&](std::uint32_t w) { empty = empty && (!c_.alive[w] || std::ranges::find(way_, w) != way_.end()); });
    if (!empty) return;
    const Segment open = c_.leaving[c_.prev[first]];
    for (std::size_t i = 1; i + 1 < way_.size(); ++i) {
      gone_(way_[i]);
      takeOut(c_, way_[i]);
    }
    c_.leaving[first] = open;
    for (const VertexId v : {first, last}) c_.stays[v] = 0, c_.open[v] = open.tag == kOpenTag ? 1 : 0;
  }

  ShoreChains& c_;
  const ShoreLoss& gone_;
  std::vector<char> has_line_;
  std::vector<VertexId> way_;
  BoxTree tree_;
};

}  // namespace

void mendEnds(ShoreChains& chains, const ShoreLoss& gone) { EndMender(chains, gone).run(); }

}  // namespace coastmesh
