#include "gis/shore/line_coarsen.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "core/metric.hpp"
#include "core/predicates.hpp"

namespace coastmesh {

namespace {

// Shares of the size.
constexpr double kShort = 0.5;
constexpr double kOff = 0.1;
constexpr int kRounds = 40;

class Coarsener {
 public:
  Coarsener(std::vector<LineChain>& chains, const LineCutter& cutter, const Pslg& shores,
            const std::vector<Segment>& lines, const std::vector<char>& stays, const SizeFunction& size)
      : chains_(chains), cutter_(cutter), nodes_(cutter.nodes()), lines_(lines), stays_(stays), size_(size) {
    std::vector<Box> boxes;
    for (const Point& p : shores.points) boxes.push_back(Box::of(p, p));
    first_node_ = boxes.size();
    for (const LineNode& node : nodes_) boxes.push_back(Box::of(node.at, node.at));
    points_ = BoxTree(boxes, BoxTree::Order::Hilbert);
    shore_points_ = &shores.points;
    is_gone_.assign(nodes_.size(), 0);
    for (const LineChain& chain : chains_)
      for (const LineStep& step : chain) joined_.insert(endsOf(step.from, step.to));
  }

  void run() {
    for (LineChain& chain : chains_) {
      gone_.assign(chain.size(), {});
      for (int round = 0; round < kRounds && coarsenOnce(chain); ++round) {
      }
    }
  }

 private:
  using Ends = std::pair<std::size_t, std::size_t>;  // items of `points_`, the lower first

  const Point& at(std::uint32_t node) const { return nodes_[node].at; }
  Ends endsOf(std::uint32_t a, std::uint32_t b) const {
    const auto number = [&](std::uint32_t node) {
      return nodes_[node].vertex != kNone ? std::size_t{nodes_[node].vertex} : first_node_ + node;
    };
    return {std::min(number(a), number(b)), std::max(number(a), number(b))};
  }

  // Removes at most every second node, so that pieces grow evenly.
  bool coarsenOnce(LineChain& chain) {
    LineChain coarser;
    std::vector<std::vector<Point>> gone;
    bool any = false;
    for (std::size_t i = 0; i < chain.size(); ++i) {
      if (i + 1 == chain.size() || !canJoin(chain, i)) {
        coarser.push_back(chain[i]);
        gone.push_back(std::move(gone_[i]));
        continue;
      }
      const std::uint32_t node = chain[i].to;
      is_gone_[node] = 1;
      joined_.insert(endsOf(chain[i].from, chain[i + 1].to));
      coarser.push_back({chain[i].from, chain[i + 1].to, chain[i].of, chain[i].is_back});
      gone_[i].push_back(at(node));
      gone_[i].insert(gone_[i].end(), gone_[i + 1].begin(), gone_[i + 1].end());
      gone.push_back(std::move(gone_[i]));
      any = true;
      ++i;
    }
    chain = std::move(coarser);
    gone_ = std::move(gone);
    return any;
  }

  // True if steps i and i + 1 may become one.
  bool canJoin(const LineChain& chain, std::size_t i) const {
    const LineStep &one = chain[i], &other = chain[i + 1];
    const LineNode& between = nodes_[one.to];
    if (between.isAtShore() || (between.of != kNone && stays_[between.of] != 0)) return false;
    if (lines_[one.of].tag != lines_[other.of].tag) return false;
    if (joined_.contains(endsOf(one.from, other.to)) || cutter_.areOnOneShore(one.from, other.to)) return false;
    const Point &a = at(one.from), &b = between.at, &c = at(other.to);
    if (a == c) return false;
    const double size = size_.at(b), most = kOff * size;
    if (std::min(distance(a, b), distance(b, c)) >= kShort * size) return false;
    const auto isNear = [&](const Point& p) { return squaredDistanceToSegment(p, a, c) <= most * most; };
    return isNear(b) && std::ranges::all_of(gone_[i], isNear) && std::ranges::all_of(gone_[i + 1], isNear) &&
           isEmpty(a, b, c);
  }

  // True if no point lies in the triangle or on its sides, so that nothing crosses side ac.
  bool isEmpty(const Point& a, const Point& b, const Point& c) const {
    Box box = Box::of(a, b);
    box.add(c);
    bool is_empty = true;
    const int turn = orient2d(a, b, c);
    points_.visit(box, [&](std::uint32_t i) {
      if (i >= first_node_ && is_gone_[i - first_node_] != 0) return;
      const Point& p = i < first_node_ ? (*shore_points_)[i] : at(i - static_cast<std::uint32_t>(first_node_));
      if (p == a || p == b || p == c) return;
      const int ab = orient2d(a, b, p), bc = orient2d(b, c, p), ca = orient2d(c, a, p);
      is_empty = is_empty && (turn == 0 ? ca != 0 : std::min({ab * turn, bc * turn, ca * turn}) < 0);
    });
    return is_empty;
  }

  std::vector<LineChain>& chains_;
  const LineCutter& cutter_;
  const std::vector<LineNode>& nodes_;
  const std::vector<Segment>& lines_;
  const std::vector<char>& stays_;
  const SizeFunction& size_;
  const std::vector<Point>* shore_points_ = nullptr;
  std::size_t first_node_ = 0;  // in `points_`, after the points of shores
  BoxTree points_;
  std::vector<char> is_gone_;  // by node
  std::set<Ends> joined_;
  std::vector<std::vector<Point>> gone_;  // for each step of the current chain: the points it replaces
};

}  // namespace

void coarsenLines(std::vector<LineChain>& chains, const LineCutter& cutter, const Pslg& shores,
                  const std::vector<Segment>& lines, const std::vector<char>& stays, const SizeFunction& size) {
  if (!chains.empty()) Coarsener(chains, cutter, shores, lines, stays, size).run();
}

}  // namespace coastmesh
