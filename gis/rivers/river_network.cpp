#include "gis/rivers/river_network.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

#include "core/ids.hpp"
#include "core/metric.hpp"
#include "core/predicates.hpp"
#include "core/union_find.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/geometry/crossing.hpp"
#include "gis/rivers/river_pieces.hpp"

namespace coastmesh {

namespace {

// A node on a line.
struct Mark {
  std::uint32_t segment = 0;  // of the line
  double share = 0.0;         // along it
  Point place;
  std::uint32_t node = 0;

  friend bool operator<(const Mark& a, const Mark& b) {
    return a.segment < b.segment || (a.segment == b.segment && a.share < b.share);
  }
};

struct Piece {  // an edge of a line
  std::uint32_t line = 0, segment = 0;
  Point a, b;
};

bool crossProperly(const Piece& p, const Piece& q) {
  return orient2d(p.a, p.b, q.a) * orient2d(p.a, p.b, q.b) < 0 && orient2d(q.a, q.b, p.a) * orient2d(q.a, q.b, p.b) < 0;
}

class NetworkBuilder {
 public:
  explicit NetworkBuilder(std::span<const PlaneRiver> rivers) : rivers_(rivers), marks_(rivers.size()) {
    std::vector<Box> boxes;
    for (std::uint32_t line = 0; line < rivers.size(); ++line) {
      const std::vector<Point>& points = rivers[line].points;
      widest_ = std::max(widest_, rivers[line].width);
      for (std::uint32_t i = 0; i + 1 < points.size(); ++i) {
        pieces_.push_back({line, i, points[i], points[i + 1]});
        boxes.push_back(Box::of(points[i], points[i + 1]));
      }
      addMark(line, 0, 0.0, points.front());
      addMark(line, static_cast<std::uint32_t>(points.size() - 2), 1.0, points.back());
    }
    tree_ = BoxTree(boxes, BoxTree::Order::Hilbert);
  }

  RiverNetwork build() {
    for (std::uint32_t line = 0; line < rivers_.size(); ++line) {
      linkEnd(line, false);
      linkEnd(line, true);
    }
    for (const Piece& piece : pieces_) markCrossings(piece);
    uniteNodes();
    for (std::uint32_t line = 0; line < rivers_.size(); ++line) cutLine(line);
    joinThrough();
    return std::move(network_);
  }

 private:
  double reachOf(std::uint32_t a, std::uint32_t b) const { return 0.5 * (rivers_[a].width + rivers_[b].width); }

  std::uint32_t addMark(std::uint32_t line, std::uint32_t segment, double share, const Point& place) {
    const auto node = static_cast<std::uint32_t>(places_.size());
    places_.push_back(place);
    marks_[line].push_back({segment, share, place, node});
    return node;
  }

  static std::uint32_t nodeOfEnd(std::uint32_t line, bool last) { return 2 * line + (last ? 1 : 0); }

  // Links the end of a line to the nearest place of each other line within reach.
  void linkEnd(std::uint32_t line, bool last) {
    const Point end = places_[nodeOfEnd(line, last)];
    std::map<std::uint32_t, std::pair<double, const Piece*>> nearest;  // by line
    tree_.visit(Box::of(end, end).grownBy(widest_), [&](std::uint32_t i) {
      const Piece& piece = pieces_[i];
      if (piece.line == line) return;
      const double gap = std::sqrt(squaredDistanceToSegment(end, piece.a, piece.b));
      if (gap > reachOf(line, piece.line)) return;
      const auto [at, is_new] = nearest.try_emplace(piece.line, gap, &piece);
      if (!is_new &&
          (gap < at->second.first || (gap == at->second.first && piece.segment < at->second.second->segment)))
        at->second = {gap, &piece};
    });
    const Point& start = places_[nodeOfEnd(line, false)];
    if (last && distance(end, start) <= 0.5 * rivers_[line].width)
      links_.emplace_back(nodeOfEnd(line, true), nodeOfEnd(line, false));
    for (const auto& [other, found] : nearest)
      links_.emplace_back(nodeOfEnd(line, last), nodeOn(*found.second, end, line));
  }

  // The node of a line beside a place: its end if that is within reach, else a new one.
  std::uint32_t nodeOn(const Piece& piece, const Point& place, std::uint32_t from) {
    for (const bool last : {false, true}) {
      const std::uint32_t end = nodeOfEnd(piece.line, last);
      if (distance(place, places_[end]) <= reachOf(from, piece.line)) return end;
    }
    const double share = shareAlongSegment(place, piece.a, piece.b);
    return addMark(piece.line, piece.segment, share, piece.a + share * (piece.b - piece.a));
  }

  void markCrossings(const Piece& piece) {
    const Box box = Box::of(piece.a, piece.b);
    const auto of_piece = static_cast<std::uint32_t>(&piece - pieces_.data());
    std::vector<std::uint32_t> found;
    tree_.visit(box, [&](std::uint32_t i) {
      if (i > of_piece && crossProperly(piece, pieces_[i])) found.push_back(i);
    });
    std::ranges::sort(found);
    for (const std::uint32_t i : found) {
      const Piece& other = pieces_[i];
      const Point place = crossingPoint(piece.a, piece.b, other.a, other.b);
      links_.emplace_back(nodeOn(piece, place, other.line), nodeOn(other, place, piece.line));
    }
  }

  // Nodes of one line that are nearer together than half its width are one.
  void uniteNodes() {
    UnionFind sets(places_.size());
    for (const auto& [a, b] : links_) sets.unite(a, b);
    for (std::uint32_t line = 0; line < rivers_.size(); ++line) {
      std::vector<Mark>& marks = marks_[line];
      std::sort(marks.begin(), marks.end());
      for (std::size_t i = 0; i + 1 < marks.size(); ++i)
        if (lengthBetween(line, marks[i], marks[i + 1]) <= 0.5 * rivers_[line].width)
          sets.unite(marks[i].node, marks[i + 1].node);
    }
    numberNodes(sets);
  }

  // A node lies at its first mark inside a line, which keeps its course; else in the middle of the ends.
  void numberNodes(UnionFind& sets) {
    const std::size_t ends = 2 * rivers_.size();
    node_of_.assign(places_.size(), kNone);
    std::vector<std::uint32_t> number(places_.size(), kNone);
    std::vector<std::size_t> count;
    std::vector<std::uint8_t> is_set;
    for (std::size_t pass = 0; pass < 2; ++pass) {
      const bool of_ends = pass == 1;
      for (auto i = static_cast<std::uint32_t>(of_ends ? 0 : ends); i < (of_ends ? ends : places_.size()); ++i) {
        std::uint32_t& node = number[sets.find(i)];
        if (node == kNone) {
          node = static_cast<std::uint32_t>(network_.nodes.size());
          network_.nodes.push_back(places_[i]);
          count.push_back(1);
          is_set.push_back(of_ends ? 0 : 1);
        } else if (is_set[node] == 0) {
          Point& place = network_.nodes[node];
          const double n = static_cast<double>(++count[node]);
          place = place + (1.0 / n) * (places_[i] - place);
        }
        node_of_[i] = node;
      }
    }
  }

  double lengthBetween(std::uint32_t line, const Mark& a, const Mark& b) const {
    const std::vector<Point>& points = rivers_[line].points;
    if (a.segment == b.segment) return distance(a.place, b.place);
    double length = distance(a.place, points[a.segment + 1]) + distance(points[b.segment], b.place);
    for (std::uint32_t i = a.segment + 1; i < b.segment; ++i) length += distance(points[i], points[i + 1]);
    return length;
  }

  void cutLine(std::uint32_t line) {
    const std::vector<Mark>& marks = marks_[line];
    const std::vector<Point>& points = rivers_[line].points;
    for (std::size_t i = 0; i + 1 < marks.size(); ++i) {
      const Mark &a = marks[i], &b = marks[i + 1];
      RiverReach reach{node_of_[a.node], node_of_[b.node], {}, {}};
      // A ring shorter than this has no land within.
      if (reach.from == reach.to && lengthBetween(line, a, b) < 4.0 * rivers_[line].width) continue;
      reach.points.push_back(network_.nodes[reach.from]);
      for (std::uint32_t k = a.segment + 1; k <= b.segment; ++k)
        if (!(points[k] == reach.points.back())) reach.points.push_back(points[k]);
      const Point& end = network_.nodes[reach.to];
      while (reach.points.size() > 1 && reach.points.back() == end) reach.points.pop_back();
      if (reach.points.back() == end) continue;
      reach.points.push_back(end);
      reach.line_of.assign(reach.points.size() - 1, line);
      network_.reaches.push_back(std::move(reach));
    }
  }

  static void turnRound(RiverReach& reach) {
    std::swap(reach.from, reach.to);
    std::ranges::reverse(reach.points);
    std::ranges::reverse(reach.line_of);
  }

  // Joins the reaches at nodes that have two.
  void joinThrough() {
    std::vector<RiverReach> parts = std::move(network_.reaches);
    network_.reaches.clear();
    std::vector<std::vector<std::uint32_t>> at(network_.nodes.size());
    for (std::uint32_t r = 0; r < parts.size(); ++r) {
      at[parts[r].from].push_back(r);
      at[parts[r].to].push_back(r);
    }
    std::vector<bool> used(parts.size());
    // The part that goes on at the node, turned to begin there.
    const auto next = [&](std::uint32_t node) -> std::optional<RiverReach> {
      if (at[node].size() != 2) return std::nullopt;
      for (const std::uint32_t r : at[node]) {
        if (used[r]) continue;
        used[r] = true;
        RiverReach part = std::move(parts[r]);
        if (part.from != node) turnRound(part);
        return part;
      }
      return std::nullopt;
    };
    const auto extend = [&](RiverReach& reach) {
      while (auto part = next(reach.to)) {
        reach.points.insert(reach.points.end(), std::next(part->points.begin()), part->points.end());
        reach.line_of.insert(reach.line_of.end(), part->line_of.begin(), part->line_of.end());
        reach.to = part->to;
      }
    };
    for (std::uint32_t r = 0; r < parts.size(); ++r) {
      if (used[r]) continue;
      used[r] = true;
      RiverReach reach = std::move(parts[r]);
      extend(reach);
      turnRound(reach);
      extend(reach);
      turnRound(reach);
      network_.reaches.push_back(std::move(reach));
    }
  }

  std::span<const PlaneRiver> rivers_;
  double widest_ = 0.0;
  std::vector<Piece> pieces_;
  BoxTree tree_;
  std::vector<Point> places_;                                   // of marks: both ends of each line, then others
  std::vector<std::vector<Mark>> marks_;                        // by line
  std::vector<std::pair<std::uint32_t, std::uint32_t>> links_;  // marks that are one node
  std::vector<std::uint32_t> node_of_;                          // of each mark
  RiverNetwork network_;
};

}  // namespace

RiverNetwork riverNetwork(std::span<const PlaneRiver> rivers) {
  std::vector<PlaneRiver> parts;
  std::vector<std::uint32_t> line_of;
  std::vector<std::uint8_t> has_part(rivers.size(), 0);
  for (RiverPiece& piece : piecesOf(rivers)) {
    parts.push_back(std::move(piece.river));
    line_of.push_back(piece.line);
    has_part[piece.line] = 1;
  }
  RiverNetwork network = NetworkBuilder(parts).build();
  for (RiverReach& reach : network.reaches)
    for (std::uint32_t& line : reach.line_of) line = line_of[line];
  for (std::uint32_t line = 0; line < rivers.size(); ++line)
    if (has_part[line] == 0) network.within.push_back(line);
  return network;
}

}  // namespace coastmesh
