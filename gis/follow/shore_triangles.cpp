#include "gis/follow/shore_triangles.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/metric.hpp"
#include "core/triangulate/delaunay.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/geometry/box.hpp"

namespace coastmesh {

namespace {

constexpr double kSampling = 3.0;       // samples per size wanted
constexpr double kMostSamples = 256.0;  // per segment
constexpr std::size_t kFollowing = 8;   // segments before and after one

std::uint8_t useOf(const Segment& s) { return !isBoundary(s) ? kInWater : isOpenTag(s.tag) ? kOnOpen : kOnShore; }

// True if segment pq comes within `reach` of the inside of ab, across it: a segment that continues ab does not.
bool isBeside(const Point& p, const Point& q, const Point& a, const Point& b, double reach) {
  constexpr double kHair = 1e-9;
  const double length = distance(a, b);
  const Point along = 1.0 / length * (b - a);
  Point from{dot(p - a, along), cross(along, p - a)}, to{dot(q - a, along), cross(along, q - a)};
  if (to.x < from.x) std::swap(from, to);
  const double first = std::max(from.x, kHair * length), last = std::min(to.x, (1.0 - kHair) * length);
  if (first >= last) return from.x == to.x && first == from.x && std::min(std::abs(from.y), std::abs(to.y)) <= reach;
  const auto across = [&](double x) { return from.y + (x - from.x) / (to.x - from.x) * (to.y - from.y); };
  const double one = across(first), other = across(last);
  return (one < 0.0) != (other < 0.0) || std::min(std::abs(one), std::abs(other)) <= reach;
}

}  // namespace

void sampleShores(ShoreGraph& graph, const SizeFunction& size, const BoxTree& lines, const ItemLoop& loop,
                  const EvenSizes* even) {
  Pslg& pslg = graph.pslg;
  std::vector<Box> boxes;
  for (const Segment& s : pslg.segments) boxes.push_back(Box::of(pslg.points[s.a], pslg.points[s.b]));
  const BoxTree tree(boxes, BoxTree::Order::Hilbert);
  std::vector<Point> middles;
  std::vector<char> on_shore;
  for (const Segment& s : pslg.segments) {
    middles.push_back(midpoint(pslg.points[s.a], pslg.points[s.b]));
    on_shore.push_back(isBoundary(s) && !isOpenTag(s.tag) ? 1 : 0);
  }
  const std::vector<double> sizes = sizesAt(middles, on_shore, size, even, loop);
  // The number of pieces of a segment.
  const auto countOf = [&](SegmentId s) {
    const Segment& segment = pslg.segments[s];
    const Point &a = pslg.points[segment.a], &b = pslg.points[segment.b];
    const double wanted = sizes[s], length = distance(a, b);
    const double count = std::min(kMostSamples, std::ceil(kSampling * length / wanted));
    if (!isBoundary(segment) || !(count >= 2.0)) return 1.0;
    bool cut = false;
    const Box around = boxes[s].grownBy(wanted);
    const auto look = [&](std::size_t other) {
      const Segment& near = pslg.segments[other];
      cut = other != s && isBeside(pslg.points[near.a], pslg.points[near.b], a, b, wanted);
    };
    // Checks following segments first: a winding shore is mostly beside itself.
    const std::size_t first = s - std::min<std::size_t>(s, kFollowing);
    for (std::size_t other = first; other <= s + kFollowing && other < boxes.size() && !cut; ++other)
      if (boxes[other].meets(around)) look(other);
    if (!cut) tree.descend([&](const Box& box, std::size_t, std::size_t) { return !cut && box.meets(around); }, look);
    lines.visit(around, [&](std::uint32_t) { cut = true; });
    return cut ? count : 1.0;
  };
  std::vector<double> counts(boxes.size());
  forEachByStretches(loop, counts.size(), [&](std::size_t s) { counts[s] = countOf(static_cast<SegmentId>(s)); });
  std::vector<Segment> pieces;
  for (SegmentId s = 0; s < boxes.size(); ++s) {
    const Segment segment = pslg.segments[s];
    const Point a = pslg.points[segment.a], b = pslg.points[segment.b];
    const double count = counts[s];
    Segment piece = segment;
    for (double i = 1.0; i < count; ++i) {
      piece.b = static_cast<VertexId>(pslg.points.size());
      pslg.points.push_back(a + (i / count) * (b - a));
      graph.source.push_back(kNone);
      pieces.push_back(piece);
      piece.a = piece.b;
    }
    piece.b = segment.b;
    pieces.push_back(piece);
  }
  pslg.segments = std::move(pieces);
}

ShoreTriangles triangulateShores(ShoreGraph&& graph, const SizeFunction& size, const ItemLoop& loop,
                                 const EvenSizes* even) {
  ShoreTriangles result;
  Pslg pslg = std::move(graph.pslg);
  result.source = std::move(graph.source);
  result.use.assign(pslg.points.size(), 0);
  for (Segment& s : pslg.segments) {
    result.use[s.a] |= useOf(s), result.use[s.b] |= useOf(s);
    result.land = std::max({result.land, s.left + 1, s.right + 1});
    result.tags.push_back(s.tag);
  }
  for (std::uint8_t& u : result.use)
    if (u == 0) u = kInWater | kLoose;
  for (Segment& s : pslg.segments) {
    if (s.left < 0) s.left = result.land;
    if (s.right < 0) s.right = result.land;
  }
  Box box;
  for (const Point& p : pslg.points) box.add(p);
  box = box.grownBy(std::max(box.xmax - box.xmin, box.ymax - box.ymin));
  const auto first = static_cast<VertexId>(pslg.points.size());
  for (const Point& p :
       {Point{box.xmin, box.ymin}, Point{box.xmax, box.ymin}, Point{box.xmax, box.ymax}, Point{box.xmin, box.ymax}}) {
    pslg.points.push_back(p);
    result.use.push_back(kAround);
    result.source.push_back(kNone);
  }
  for (VertexId i = 0; i < 4; ++i) pslg.segments.push_back({first + i, first + (i + 1) % 4, 0, result.land, kOutside});
  result.tags.resize(pslg.segments.size() + 1, 0);
  if (even != nullptr) {
    std::vector<char> on_shore(result.use.size());
    std::ranges::transform(result.use, on_shore.begin(),
                           [](std::uint8_t use) { return (use & kOnShore) != 0 ? 1 : 0; });
    result.rate = even->rate;
    result.size_at = sizesAt(pslg.points, on_shore, size, even, loop);
  }
  result.mesh = constrainedDelaunay(pslg, {}, loop);
  result.region_was = result.mesh.regions;
  result.home.assign(pslg.points.size(), kNone);
  result.size.resize(result.mesh.triangles.size());
  result.width.resize(result.mesh.triangles.size());
  for (TriId t = 0; t < result.mesh.triangles.size(); ++t)
    for (const VertexId v : result.mesh.triangles[t].v) result.home[v] = t;
  forEachByStretches(loop, result.size.size(),
                     [&](std::size_t t) { measureTriangle(result, static_cast<TriId>(t), size); });
  return result;
}

void measureTriangle(ShoreTriangles& triangles, TriId t, const SizeFunction& size) {
  const auto& v = triangles.mesh.triangles[t].v;
  const Point &a = triangles.mesh.point(v[0]), &b = triangles.mesh.point(v[1]), &c = triangles.mesh.point(v[2]);
  const Point centre = (1.0 / 3.0) * (a + b + c);
  double wanted = size.most();
  if (std::isnan(triangles.rate)) {
    wanted = size.at(centre);
  } else {
    for (const VertexId corner : v)
      wanted =
          std::min(wanted, triangles.size_at[corner] + triangles.rate * distance(centre, triangles.mesh.point(corner)));
  }
  triangles.size[t] = wanted;
  triangles.width[t] = 2.0 * std::sqrt(squaredLength(circumcenterOffset(a, b, c))) / triangles.size[t];
}

std::uint8_t useOf(const ShoreTriangles& triangles, VertexId v) {
  const TriMesh& mesh = triangles.mesh;
  std::uint8_t use = 0;
  forTrianglesRound(triangles, v, [&](TriId t) {
    const EdgeRef e = edgeRef(t, prev3(mesh.cornerOf(t, v)));  // from v
    const SegmentId s = mesh.segment(e);
    if (s == kNone) return;
    const bool is_shore = (mesh.regions[t] == triangles.land) != (mesh.regions[triOf(mesh.twin(e))] == triangles.land);
    use |= !is_shore ? kInWater : isOpenTag(triangles.tags[s]) ? kOnOpen : kOnShore;
  });
  return use != 0 ? use : std::uint8_t{kInWater | kLoose};
}

ShoreGraph graphOf(const ShoreTriangles& triangles) {
  const TriMesh& mesh = triangles.mesh;
  ShoreGraph graph;
  std::vector<VertexId> number(mesh.points.size(), kNone);
  for (VertexId v = 0; v < number.size(); ++v) {
    if (triangles.home[v] == kNone || (triangles.use[v] & kAround) != 0) continue;
    number[v] = static_cast<VertexId>(graph.pslg.points.size());
    graph.pslg.points.push_back(mesh.point(v));
    graph.source.push_back(triangles.source[v]);
  }
  const auto labelOf = [&](TriId t) { return mesh.regions[t] == triangles.land ? kOutside : mesh.regions[t]; };
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i), back = mesh.twin(e);
      if (mesh.segment(e) == kNone || back == kNone || e > back) continue;
      graph.pslg.segments.push_back({number[mesh.origin(e)], number[mesh.target(e)], triangles.tags[mesh.segment(e)],
                                     labelOf(t), labelOf(triOf(back))});
    }
  }
  return graph;
}

}  // namespace coastmesh
