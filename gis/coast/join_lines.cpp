#include "gis/coast/join_lines.hpp"

#include <algorithm>
#include <cstdint>

#include "core/ids.hpp"
#include "gis/coast/line_network.hpp"

namespace coastmesh {

namespace {

// Line ends by node: end 2·line is its first point, 2·line + 1 its last.
struct LineEnds {
  std::vector<std::uint32_t> node_of;               // by end; kNone for an empty line
  std::vector<std::vector<std::uint32_t>> ends_at;  // by node

  explicit LineEnds(const std::vector<std::vector<Point>>& lines) : node_of(2 * lines.size(), kNone) {
    std::vector<Point> places;
    for (const auto& line : lines) {
      if (line.empty()) continue;
      places.push_back(line.front());
      places.push_back(line.back());
    }
    std::sort(places.begin(), places.end(), lexLess);
    places.erase(std::unique(places.begin(), places.end()), places.end());
    ends_at.resize(places.size());
    for (std::uint32_t end = 0; end < node_of.size(); ++end) {
      const auto& line = lines[end / 2];
      if (line.empty()) continue;
      const Point& p = end % 2 == 0 ? line.front() : line.back();
      const auto at = std::lower_bound(places.begin(), places.end(), p, lexLess);
      node_of[end] = static_cast<std::uint32_t>(at - places.begin());
      ends_at[node_of[end]].push_back(end);
    }
  }
  // The other end at a node where exactly two meet, else kNone.
  std::uint32_t partner(std::uint32_t end) const {
    const auto& ends = ends_at[node_of[end]];
    if (ends.size() != 2) return kNone;
    return ends[0] == end ? ends[1] : ends[0];
  }
};

// The arc that leaves `first` (an end of a line) and continues through nodes where exactly two ends meet.
Arc followFrom(std::uint32_t first, const std::vector<std::vector<Point>>& lines, const LineEnds& ends,
               std::vector<char>& used) {
  Arc arc;
  arc.from = ends.node_of[first];
  arc.origin = first / 2;
  std::uint32_t end = first;
  while (end != kNone && !used[end / 2]) {
    used[end / 2] = 1;
    arc.origin = std::min<std::size_t>(arc.origin, end / 2);
    std::vector<Point> points = lines[end / 2];
    if (end % 2 == 1) std::reverse(points.begin(), points.end());
    arc.balance += (end % 2 == 1 ? -1 : 1) * static_cast<std::int64_t>(points.size() - 1);
    const auto skip = arc.points.empty() ? 0 : 1;
    arc.points.insert(arc.points.end(), points.begin() + skip, points.end());
    arc.to = ends.node_of[end ^ 1u];
    end = ends.partner(end ^ 1u);
  }
  return arc;
}

std::vector<Arc> joinAtSimpleNodes(const std::vector<std::vector<Point>>& lines, const LineEnds& ends) {
  std::vector<Arc> arcs;
  std::vector<char> used(lines.size(), 0);
  for (std::size_t i = 0; i < lines.size(); ++i) used[i] = lines[i].empty();
  // First from ends without a partner, then around the closed chains that remain.
  for (const bool from_anywhere : {false, true}) {
    for (std::uint32_t end = 0; end < 2 * lines.size(); ++end) {
      if (used[end / 2] || (!from_anywhere && ends.partner(end) != kNone)) continue;
      arcs.push_back(followFrom(end, lines, ends, used));
    }
  }
  return arcs;
}

// Lines without repeated points; empty if fewer than two distinct points are left.
std::vector<std::vector<Point>> withoutRepeats(const std::vector<std::vector<Point>>& lines) {
  std::vector<std::vector<Point>> clean = lines;
  for (auto& line : clean) {
    line.erase(std::unique(line.begin(), line.end()), line.end());
    if (line.size() < 2) line.clear();
  }
  return clean;
}

}  // namespace

JoinedLines joinLines(const std::vector<std::vector<Point>>& given) {
  const std::vector<std::vector<Point>> lines = withoutRepeats(given);
  const LineEnds ends(lines);
  const std::vector<Arc> arcs = joinAtSimpleNodes(lines, ends);

  JoinedLines joined;
  const PeeledNetwork peeled = peelNetwork(arcs, static_cast<std::uint32_t>(ends.ends_at.size()));
  for (const auto& ring : peeled.rings) {
    JoinedLines::Part part{{}, arcs[ring.front().arc].origin};
    std::int64_t balance = 0;
    for (const ArcUse& use : ring) {
      std::vector<Point> points = arcs[use.arc].points;
      if (use.reversed) std::reverse(points.begin(), points.end());
      part.points.insert(part.points.end(), points.begin(), points.end() - 1);
      part.origin = std::min(part.origin, arcs[use.arc].origin);
      balance += use.reversed ? -arcs[use.arc].balance : arcs[use.arc].balance;
    }
    if (balance < 0) std::reverse(part.points.begin(), part.points.end());
    joined.rings.push_back(std::move(part));
  }
  for (const std::uint32_t arc : peeled.open) {
    joined.open.push_back({arcs[arc].points, arcs[arc].origin});
    if (arcs[arc].balance < 0) std::reverse(joined.open.back().points.begin(), joined.open.back().points.end());
  }
  const auto by_origin = [](const JoinedLines::Part& a, const JoinedLines::Part& b) { return a.origin < b.origin; };
  std::stable_sort(joined.rings.begin(), joined.rings.end(), by_origin);
  std::stable_sort(joined.open.begin(), joined.open.end(), by_origin);
  return joined;
}

}  // namespace coastmesh
