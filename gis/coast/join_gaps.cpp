#include "gis/coast/join_gaps.hpp"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdint>
#include <iterator>
#include <numbers>
#include <utility>

#include "gis/coast/snap_reach.hpp"
#include "gis/geometry/box_tree.hpp"

namespace coastmesh {

namespace {

// An end of an open part that no other line meets.
struct DeadEnd {
  Point place;
  std::uint32_t part;
  bool is_last;  // of the part's points
};

std::vector<DeadEnd> deadEnds(const std::vector<std::vector<Point>>& lines,
                              const std::vector<JoinedLines::Part>& parts) {
  std::vector<Point> ends;
  for (const auto& line : lines) {
    if (line.empty()) continue;
    ends.push_back(line.front());
    ends.push_back(line.back());
  }
  std::ranges::sort(ends, lexLess);
  std::vector<DeadEnd> dead;
  for (std::uint32_t p = 0; p < parts.size(); ++p) {
    for (const bool is_last : {false, true}) {
      const Point& place = is_last ? parts[p].points.back() : parts[p].points.front();
      if (std::ranges::equal_range(ends, place, lexLess).size() == 1) dead.push_back({place, p, is_last});
    }
  }
  return dead;
}

// For an order by length: the differences of coordinates, as long as on the ground relative to one another.
double lengthFor(const Point& a, const Point& b, bool geographic) {
  const double narrower = geographic ? std::cos(0.5 * (a.y + b.y) * std::numbers::pi / 180.0) : 1.0;
  return std::hypot((a.x - b.x) * narrower, a.y - b.y);
}

struct Pair {
  double length;
  std::uint32_t a, b;  // a < b

  friend auto operator<=>(const Pair&, const Pair&) = default;
};

// Pairs of ends within reach of one another, the nearest first. A part needs three points besides the end that moves to
// become a ring.
std::vector<Pair> pairsWithin(const SnapReach& reach, const std::vector<DeadEnd>& ends,
                              const std::vector<JoinedLines::Part>& parts, bool geographic) {
  std::vector<Box> boxes;
  for (const DeadEnd& end : ends) boxes.push_back(Box::of(end.place, end.place));
  const BoxTree tree(boxes, BoxTree::Order::Hilbert);
  std::vector<Pair> pairs;
  for (std::uint32_t a = 0; a < ends.size(); ++a) {
    const Point& p = ends[a].place;
    tree.visit(reach.around(boxes[a]), [&](std::uint32_t b) {
      const Point& q = ends[b].place;
      if (b <= a || !reach.holds(p, p, q, q)) return;
      if (ends[a].part == ends[b].part && parts[ends[a].part].points.size() < 4) return;
      pairs.push_back({lengthFor(p, q, geographic), a, b});
    });
  }
  std::ranges::sort(pairs);
  return pairs;
}

}  // namespace

JoinedLines joinAcrossGaps(const std::vector<std::vector<Point>>& lines, const SnapDistance& snap, const Crs& crs,
                           std::vector<ClosedGap>& gaps) {
  JoinedLines joined = joinLines(lines);
  if (!(snap.length > 0.0) || joined.open.empty()) return joined;
  const std::vector<DeadEnd> ends = deadEnds(lines, joined.open);
  Box extent;
  for (const DeadEnd& end : ends) extent.add(end.place);
  const SnapReach reach(snap, crs, extent);
  std::vector<bool> is_joined(ends.size(), false), changes(joined.open.size(), false);
  bool any = false;
  for (const auto& [length, a, b] : pairsWithin(reach, ends, joined.open, crs.geographic)) {
    if (is_joined[a] || is_joined[b]) continue;
    is_joined[a] = is_joined[b] = any = true;
    std::vector<Point>& points = joined.open[ends[b].part].points;
    (ends[b].is_last ? points.back() : points.front()) = ends[a].place;
    changes[ends[a].part] = changes[ends[b].part] = true;
    gaps.push_back({ends[b].place, ends[a].place});
  }
  if (!any) return joined;

  // Other parts were left open for reasons that only all lines together show.
  std::vector<std::vector<Point>> changed;
  std::vector<std::size_t> origins;
  std::vector<JoinedLines::Part> open;
  for (std::size_t p = 0; p < joined.open.size(); ++p) {
    if (!changes[p]) {
      open.push_back(std::move(joined.open[p]));
      continue;
    }
    changed.push_back(std::move(joined.open[p].points));
    origins.push_back(joined.open[p].origin);
  }
  JoinedLines again = joinLines(changed);
  for (std::vector<JoinedLines::Part>* parts : {&again.rings, &again.open})
    for (JoinedLines::Part& part : *parts) part.origin = origins[part.origin];
  std::ranges::move(again.rings, std::back_inserter(joined.rings));
  std::ranges::move(again.open, std::back_inserter(open));
  joined.open = std::move(open);
  for (std::vector<JoinedLines::Part>* parts : {&joined.rings, &joined.open})
    std::ranges::stable_sort(*parts, {}, &JoinedLines::Part::origin);
  return joined;
}

}  // namespace coastmesh
