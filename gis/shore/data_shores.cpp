#include "gis/shore/data_shores.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <tuple>
#include <utility>

#include "core/metric.hpp"
#include "core/predicates.hpp"
#include "core/triangulate/label_regions.hpp"
#include "gis/geometry/box_tree.hpp"

namespace coastmesh {

namespace {

// A fast test for membership in a small set of points, with some false positives.
class PointFilter {
 public:
  void add(const Point& p) { marked_[slotOf(p)] = 1; }
  bool mayHold(const Point& p) const { return marked_[slotOf(p)] != 0; }

 private:
  static constexpr int kBits = 17;

  static std::size_t slotOf(const Point& p) {
    const std::uint64_t mixed =
        (std::bit_cast<std::uint64_t>(p.x) ^ std::rotl(std::bit_cast<std::uint64_t>(p.y), 23)) * 0x9E3779B97F4A7C15u;
    return static_cast<std::size_t>(mixed >> (64 - kBits));
  }

  std::vector<char> marked_ = std::vector<char>(std::size_t{1} << kBits, 0);
};

bool isBefore(const Point& a, const Point& b) { return std::tie(a.x, a.y) < std::tie(b.x, b.y); }

double squaredDistanceToBox(const Point& p, const Box& box) {
  const double x = std::max({box.xmin - p.x, 0.0, p.x - box.xmax}), y = std::max({box.ymin - p.y, 0.0, p.y - box.ymax});
  return x * x + y * y;
}

// True if the way from a vertex of the line to q begins on its left.
bool isToTheLeft(const std::vector<Point>& line, std::size_t i, const Point& q) {
  const Point& p = line[i];
  if (i == 0) return cross(line[1] - p, q - p) >= 0.0;
  const Point in = p - line[i - 1];
  if (i + 1 == line.size()) return cross(in, q - p) >= 0.0;
  const Point out = line[i + 1] - p;
  const bool left_of_in = cross(in, q - p) >= 0.0, left_of_out = cross(out, q - p) >= 0.0;
  return cross(in, out) >= 0.0 ? left_of_in && left_of_out : left_of_in || left_of_out;
}

// The vertex of `from` and the point of `to` that are nearest to each other across water, if nearer than `least`,
// squared.
void findNearest(const std::vector<Point>& from, const std::vector<Point>& to, double& least,
                 std::pair<Point, Point>& ends) {
  Box box;
  for (const Point& p : to) box.add(p);
  for (std::size_t k = 0; k < from.size(); ++k) {
    const Point& p = from[k];
    if (squaredDistanceToBox(p, box) >= least) continue;
    for (std::size_t i = 0; i + 1 < to.size(); ++i) {
      const Point q = nearestOnSegment(p, to[i], to[i + 1]);
      const double off = squaredDistance(p, q);
      if (off >= least || cross(to[i + 1] - to[i], p - to[i]) < 0.0 || !isToTheLeft(from, k, q)) continue;
      least = off;
      ends = {p, q};
    }
  }
}

}  // namespace

DataShores::DataShores(const Pslg& pslg) : at_(pslg.points), next_(pslg.points.size(), kNone) {
  std::vector<VertexId> twice;
  for (const Segment& s : pslg.segments) {
    if (!isBoundary(s)) continue;
    const VertexId from = s.left >= 0 ? s.a : s.b, to = s.left >= 0 ? s.b : s.a;
    if (next_[from] != kNone) twice.push_back(from);
    next_[from] = to;
  }
  for (const VertexId v : twice) next_[v] = kNone;
}

std::vector<VertexId> DataShores::find(const std::vector<Point>& points) const {
  std::vector<std::pair<Point, std::size_t>> sorted;
  PointFilter filter;
  for (std::size_t i = 0; i < points.size(); ++i) {
    sorted.emplace_back(points[i], i);
    filter.add(points[i]);
  }
  std::ranges::sort(sorted, isBefore, [](const auto& item) { return item.first; });
  std::vector<VertexId> found(points.size(), kNone);
  for (VertexId v = 0; v < at_.size(); ++v) {
    if (next_[v] == kNone || !filter.mayHold(at_[v])) continue;
    const auto same = std::ranges::equal_range(sorted, at_[v], isBefore, [](const auto& item) { return item.first; });
    for (const auto& [at, i] : same) found[i] = v;
  }
  return found;
}

std::vector<Point> DataShores::piece(VertexId from, const Point& to, const Box& within) const {
  std::vector<Point> points{at_[from]};
  for (VertexId v = next_[from]; v != kNone && v != from; v = next_[v]) {
    points.push_back(at_[v]);
    if (at_[v] == to) return points;
    if (!within.meets(Box::of(at_[v], at_[v]))) break;
  }
  return {};
}

// The ring through v, and its first vertex; empty if it leaves the box.
std::vector<Point> DataShores::ringFrom(VertexId v, const Box& within, VertexId& first) const {
  std::vector<Point> ring{at_[v]};
  first = v;
  for (VertexId next = next_[v]; next != kNone; next = next_[next]) {
    ring.push_back(at_[next]);
    first = std::min(first, next);
    if (next == v) return ring;
    if (!within.meets(Box::of(at_[next], at_[next]))) break;
  }
  return {};
}

DataShores::Islands DataShores::islandsAcross(const std::vector<Across>& lines) const {
  Islands islands;
  islands.across.resize(lines.size());
  if (lines.empty()) return islands;
  std::vector<Box> boxes;
  for (const Across& line : lines) boxes.push_back(Box::of(line.a, line.b));
  const BoxTree tree(boxes, BoxTree::Order::Hilbert);
  std::map<VertexId, std::size_t> number;  // by the first vertex of a ring
  for (VertexId v = 0; v < at_.size(); ++v) {
    if (next_[v] == kNone) continue;
    const Point &p = at_[v], &q = at_[next_[v]];
    tree.visit(Box::of(p, q), [&](std::uint32_t i) {
      const auto& [a, b, reach] = lines[i];
      if (orient2d(a, b, p) * orient2d(a, b, q) >= 0 || orient2d(p, q, a) * orient2d(p, q, b) >= 0) return;
      VertexId first = kNone;
      std::vector<Point> ring = ringFrom(v, boxes[i].grownBy(reach), first);
      if (ring.empty()) return;
      const auto [at, is_new] = number.emplace(first, islands.rings.size());
      if (is_new) islands.rings.push_back(std::move(ring));
      if (std::ranges::find(islands.across[i], at->second) == islands.across[i].end())
        islands.across[i].push_back(at->second);
    });
  }
  return islands;
}

ShoreGap gapBetween(const std::vector<Point>& a, const std::vector<Point>& b) {
  double least = std::numeric_limits<double>::infinity();
  std::pair<Point, Point> ends;
  findNearest(a, b, least, ends);
  findNearest(b, a, least, ends);
  return {std::sqrt(least), midpoint(ends.first, ends.second)};
}

}  // namespace coastmesh
