#include "gis/shore/shore_chains.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_set>

#include "core/metric.hpp"
#include "gis/coast/segment_tags.hpp"

namespace coastmesh {

namespace {

// An open boundary that turns by more than this has a corner, which stays.
constexpr double kCosineOfCorner = 0.985;  // of 10 degrees

bool isCorner(const Point& from, const Point& at, const Point& to) {
  const Point in = at - from, out = to - at;
  return dot(in, out) < kCosineOfCorner * std::sqrt(squaredLength(in) * squaredLength(out));
}

}  // namespace

ShoreChains chainsOf(ShoreGraph&& graph, const SizeFunction& size, const ItemLoop& loop, const EvenSizes* even) {
  ShoreChains chains;
  const std::size_t count = graph.pslg.points.size();
  chains.at = std::move(graph.pslg.points);
  chains.source = std::move(graph.source);
  chains.next.assign(count, kNone);
  chains.prev.assign(count, kNone);
  chains.leaving.assign(count, {kNone, kNone, 0, kOutside, kOutside});
  chains.stays.assign(count, 0);
  chains.open.assign(count, 0);
  chains.alive.assign(count, 1);
  std::vector<std::uint8_t> degree(count, 0);
  for (const Segment& s : graph.pslg.segments) {
    if (!isBoundary(s)) {
      chains.lines.push_back(s);
      chains.stays[s.a] = chains.stays[s.b] = 1;
      continue;
    }
    const VertexId from = s.left >= 0 ? s.a : s.b, to = s.left >= 0 ? s.b : s.a;
    for (const VertexId v : {from, to})
      if (degree[v] < 3) ++degree[v];
    if (chains.next[from] != kNone || chains.prev[to] != kNone) {  // the graph touches itself here
      chains.lines.push_back(s);
      chains.stays[from] = chains.stays[to] = 1;
      continue;
    }
    chains.next[from] = to;
    chains.prev[to] = from;
    chains.leaving[from] = {from, to, s.tag, s.left >= 0 ? s.left : s.right, s.left >= 0 ? s.right : s.left};
  }
  for (const Segment& s : chains.lines) chains.line_ends.push_back(std::minmax(s.a, s.b));
  std::ranges::sort(chains.line_ends);
  for (VertexId v = 0; v < count; ++v) {
    if (degree[v] != 2 || chains.next[v] == kNone || chains.prev[v] == kNone) {
      chains.stays[v] = 1;
      continue;
    }
    const Segment &in = chains.leaving[chains.prev[v]], &out = chains.leaving[v];
    if (in.tag != out.tag || in.left != out.left || in.right != out.right) chains.stays[v] = 1;
    if (in.tag != kOpenTag || out.tag != kOpenTag) continue;
    chains.open[v] = 1;
    if (isCorner(chains.at[chains.prev[v]], chains.at[v], chains.at[chains.next[v]])) chains.stays[v] = 1;
  }
  std::vector<char> on_shore(even != nullptr ? count : 0, 0);
  for (const Segment& s : chains.leaving)
    if (even != nullptr && s.a != kNone && !isOpenTag(s.tag)) on_shore[s.a] = on_shore[s.b] = 1;
  chains.size = sizesAt(chains.at, on_shore, size, even, loop);
  return chains;
}

ShoreGraph graphOf(ShoreChains&& chains) {
  ShoreGraph graph;
  std::vector<VertexId> number(chains.at.size(), kNone);
  for (VertexId v = 0; v < number.size(); ++v) {
    if (!chains.alive[v]) continue;
    number[v] = static_cast<VertexId>(graph.pslg.points.size());
    graph.pslg.points.push_back(chains.at[v]);
    graph.source.push_back(chains.source[v]);
  }
  for (VertexId v = 0; v < number.size(); ++v) {
    if (!chains.alive[v] || chains.next[v] == kNone) continue;
    Segment s = chains.leaving[v];
    s.a = number[v];
    s.b = number[chains.next[v]];
    graph.pslg.segments.push_back(s);
  }
  for (Segment s : chains.lines) {
    s.a = number[s.a];
    s.b = number[s.b];
    graph.pslg.segments.push_back(s);
  }
  return graph;
}

void keepAsked(ShoreChains& chains, const std::vector<VertexId>& asked) {
  if (asked.empty()) return;
  const std::unordered_set<VertexId> sources(asked.begin(), asked.end());
  for (VertexId v = 0; v < chains.at.size(); ++v)
    if (sources.contains(chains.source[v])) chains.stays[v] = 1;
}

double waterAngle(const Point& a, const Point& b, const Point& c) {
  const Point out = c - b, in = a - b;
  const double angle = std::atan2(cross(out, in), dot(out, in));
  return angle < 0.0 ? angle + 2.0 * std::numbers::pi : angle;
}

bool leavesFrame(const ShoreChains& chains, VertexId v, const Point& x) {
  if (chains.frame.empty()) return false;
  constexpr double kOfSize = 1e-3, kOfSegments = 0.1;
  const Point &a = chains.at[chains.prev[v]], &from = chains.at[v], &b = chains.at[chains.next[v]];
  const double out = distance(from, b), least = std::min(distance(a, from), out);
  if (!(least > 0.0)) return false;
  // A vertex on the frame may be outside of it by rounding: the way begins in the water beside it.
  const double angle = 0.5 * waterAngle(a, from, b), c = std::cos(angle), s = std::sin(angle);
  const double share = std::min(kOfSize * chains.size[v], kOfSegments * least) / out;
  const Point along = share * (b - from);
  return chains.frame.parts(from + Point{c * along.x - s * along.y, s * along.x + c * along.y}, x);
}

bool canTakeOut(const ShoreChains& chains, VertexId v) {
  if (chains.stays[v] || chains.next[v] == kNone || chains.prev[v] == kNone) return false;
  const VertexId p = chains.prev[v], q = chains.next[v];
  return chains.next[q] != p &&
         !std::ranges::binary_search(chains.line_ends, std::pair<VertexId, VertexId>(std::minmax(p, q)));
}

void dropSamples(ShoreChains& chains) {
  constexpr double kNothing = 1e-9;  // of the size: rounding of points on a straight line
  for (VertexId v = 0; v < chains.at.size(); ++v) {
    if (!chains.alive[v] || chains.source[v] != kNone || !canTakeOut(chains, v)) continue;
    const Point &a = chains.at[chains.prev[v]], &b = chains.at[chains.next[v]];
    const double most = kNothing * chains.size[v];
    if (squaredDistanceToSegment(chains.at[v], a, b) <= most * most) takeOut(chains, v);
  }
}

void drop(ShoreChains& chains, VertexId v) {
  chains.next[v] = chains.prev[v] = kNone;
  chains.alive[v] = 0;
}

VertexId cutAfter(ShoreChains& chains, VertexId v, const Point& x, double size) {
  const auto made = static_cast<VertexId>(chains.at.size());
  const VertexId q = chains.next[v];
  const Segment leaving = chains.leaving[v];
  chains.at.push_back(x);
  chains.source.push_back(kNone);
  chains.next.push_back(q);
  chains.prev.push_back(v);
  chains.leaving.push_back(leaving);
  chains.stays.push_back(0);
  chains.open.push_back(0);
  chains.alive.push_back(1);
  chains.size.push_back(size);
  if (!chains.least.empty()) chains.least.push_back(chains.least[v]);
  chains.next[v] = chains.prev[q] = made;
  return made;
}

void takeOut(ShoreChains& chains, VertexId v) {
  const VertexId p = chains.prev[v], q = chains.next[v];
  chains.next[p] = q;
  chains.prev[q] = p;
  drop(chains, v);
}

}  // namespace coastmesh
