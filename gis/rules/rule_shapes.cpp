#include "gis/rules/rule_shapes.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace coastmesh {
namespace {

constexpr double kFarthest = 0.2;  // share of a mesh edge's length: places farther from a line are not along it

Box shifted(const Box& box, double dx) { return {box.xmin + dx, box.ymin, box.xmax + dx, box.ymax}; }

}  // namespace

void RuleShapes::addArea(std::size_t rule, Polygon polygon) {
  areas_.push_back({rule, AreaSearch(std::move(polygon))});
}

void RuleShapes::addLine(std::size_t rule, const std::vector<Point>& line, bool closed) {
  for (std::size_t i = 0; i + 1 < line.size(); ++i) pieces_.push_back({rule, line[i], line[i + 1]});
  if (closed && !line.empty()) pieces_.push_back({rule, line.back(), line.front()});
}

void RuleShapes::build() {
  std::vector<Box> boxes;
  for (const Area& area : areas_) boxes.push_back(area.area.box());
  area_tree_ = BoxTree(boxes, BoxTree::Order::Hilbert);
  boxes.clear();
  for (const Piece& piece : pieces_) boxes.push_back(Box::of(piece.a, piece.b));
  piece_tree_ = BoxTree(boxes, BoxTree::Order::Hilbert);
}

std::vector<std::size_t> RuleShapes::rulesNear(const Point& p, double far, const RulePlane& plane) const {
  std::vector<std::size_t> near;
  const double shrink = plane.shrinkAt(p.y);
  for (const double turn : plane.turns()) {
    const Point place{p.x + turn, p.y};
    piece_tree_.visit(plane.around(Box::of(place, place), far), [&](std::uint32_t i) {
      const Piece& piece = pieces_[i];
      if (RulePlane::distance(place, piece.a, piece.b, shrink, nullptr) <= far) near.push_back(piece.rule);
    });
  }
  std::ranges::sort(near);
  const auto repeated = std::ranges::unique(near);
  near.erase(repeated.begin(), repeated.end());
  return near;
}

// One opening or river may be drawn in several lines, which meet within an edge: for each of the edge's places the last
// line of a kind counts, and the first of these for the edge. Where lines of different kinds meet within an edge that
// they cover together, its middle decides.
std::optional<std::size_t> RuleShapes::lastAlong(const PlacedEdge& edge, const std::vector<BoundaryRule>& rules,
                                                 const RulePlane& plane) const {
  const double far = kFarthest * edge.element;
  std::array<std::vector<std::size_t>, 3> near;
  const std::array<Point, 3> places{edge.a, edge.middle(), edge.b};
  for (std::size_t k = 0; k < places.size(); ++k) {
    near[k] = rulesNear(places[k], far, plane);
    if (near[k].empty()) return std::nullopt;
  }
  const auto lastOfKind = [&](const std::vector<std::size_t>& some, const BoundaryKind& kind) {
    std::optional<std::size_t> last;
    for (const std::size_t rule : some)
      if (rules[rule].kind == kind) last = rule;
    return last;
  };
  std::optional<std::size_t> last;
  for (const std::size_t rule : near[1]) {
    const BoundaryKind& kind = rules[rule].kind;
    last = std::max(last, std::min({lastOfKind(near[0], kind), lastOfKind(near[1], kind), lastOfKind(near[2], kind)}));
  }
  if (last) return last;
  const bool covered = !rulesNear(edge.at(0.25), far, plane).empty() && !rulesNear(edge.at(0.75), far, plane).empty();
  return covered ? std::optional(near[1].back()) : std::nullopt;
}

std::optional<std::size_t> RuleShapes::lastAround(const PlacedEdge& edge, const std::vector<BoundaryRule>& rules,
                                                  const RulePlane& plane, std::vector<bool>& used) const {
  std::optional<std::size_t> last;
  const Point p = edge.middle();
  for (const double turn : plane.turns()) {
    const Point place{p.x + turn, p.y};
    area_tree_.visit(Box::of(place, place), [&](std::uint32_t i) {
      const auto& [rule, area] = areas_[i];
      if (last && rule < *last && used[rule]) return;
      if (!edge.outer && rules[rule].opens()) return;
      if (!area.contains(p, plane)) return;
      used[rule] = true;
      last = std::max(last, std::optional(rule));
    });
  }
  return last;
}

bool RuleShapes::anyNear(const PlacedEdge& edge, double reach, double most, const RulePlane& plane) const {
  const Box box = plane.around(Box::of(edge.a, edge.b), reach);
  bool found = false;
  for (const double turn : plane.turns()) {
    const auto enter = [&](const Box& other, std::size_t, std::size_t) {
      return !found && other.meets(shifted(box, turn));
    };
    piece_tree_.descend(enter, [&](std::uint32_t) { found = true; });
    area_tree_.descend(enter, [&](std::uint32_t i) {
      const Box& area = areas_[i].area.box();
      found = found || plane.distance({area.xmin, area.ymin}, {area.xmax, area.ymax}) <= most;
    });
  }
  return found;
}

std::vector<Point> RuleShapes::lineOf(std::size_t rule) const {
  std::vector<Point> line;
  for (auto piece = std::ranges::lower_bound(pieces_, rule, {}, &Piece::rule);
       piece != pieces_.end() && piece->rule == rule; ++piece) {
    if (line.empty()) line.push_back(piece->a);
    line.push_back(piece->b);
  }
  return line;
}

Box RuleShapes::boxOf(std::size_t rule) const {
  const auto area = std::ranges::lower_bound(areas_, rule, {}, &Area::rule);
  return area != areas_.end() && area->rule == rule ? area->area.box() : Box{};
}

}  // namespace coastmesh
