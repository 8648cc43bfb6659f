#include "gis/follow/shore_graph.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/delaunay.hpp"
#include "core/metric.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/geometry/box_tree.hpp"

namespace coastmesh {

namespace {

constexpr double kSampling = 3.0;        // samples to a length of the size wanted
constexpr double kMostSamples = 256.0;   // to a segment
constexpr double kShiftOfCopies = 0.05;  // as a share of the size
constexpr double kShiftOfHeight = 0.25;  // as a share of the least height of the triangles there

std::vector<std::uint8_t> usesOf(const Pslg& pslg) {
  std::vector<std::uint8_t> use(pslg.points.size(), 0);
  for (const Segment& s : pslg.segments)
    for (const VertexId v : {s.a, s.b}) use[v] |= !isBoundary(s) ? kInWater : s.tag == kOpenTag ? kOnOpen : kOnShore;
  for (std::uint8_t& u : use)
    if (u == 0) u = kInWater;
  return use;
}

}  // namespace

void sampleShores(ShoreGraph& graph, const SizeFunction& size, const BoxTree& lines) {
  Pslg& pslg = graph.pslg;
  std::vector<Box> boxes;
  for (const Segment& s : pslg.segments) boxes.push_back(Box::of(pslg.points[s.a], pslg.points[s.b]));
  const BoxTree tree(boxes, BoxTree::Order::Hilbert);
  std::vector<Segment> pieces;
  for (SegmentId s = 0; s < boxes.size(); ++s) {
    const Segment segment = pslg.segments[s];
    const Point a = pslg.points[segment.a], b = pslg.points[segment.b];
    const double wanted = size.at(midpoint(a, b)), length = distance(a, b);
    const double count = std::min(kMostSamples, std::ceil(kSampling * length / wanted));
    bool cut = false;
    if (isBoundary(segment) && count >= 2.0) {
      tree.visit(boxes[s].grownBy(wanted), [&](std::uint32_t other) { cut = cut || other != s; });
      lines.visit(boxes[s].grownBy(wanted), [&](std::uint32_t) { cut = true; });
    }
    Segment piece = segment;
    for (double i = 1.0; cut && i < count; ++i) {
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

ShoreTriangles triangulateShores(const ShoreGraph& graph, const SizeFunction& size) {
  ShoreTriangles result;
  Pslg pslg = graph.pslg;
  result.use = usesOf(pslg);
  for (const Segment& s : pslg.segments) result.land = std::max({result.land, s.left + 1, s.right + 1});
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
  }
  for (VertexId i = 0; i < 4; ++i) pslg.segments.push_back({first + i, first + (i + 1) % 4, 0, result.land, kOutside});
  result.mesh = constrainedDelaunay(pslg);
  result.region_was = result.mesh.regions;
  result.width.reserve(result.mesh.triangles.size());
  for (const Triangle& t : result.mesh.triangles) {
    const Point &a = pslg.points[t.v[0]], &b = pslg.points[t.v[1]], &c = pslg.points[t.v[2]];
    result.size.push_back(size.at((1.0 / 3.0) * (a + b + c)));
    result.width.push_back(2.0 * std::sqrt(squaredLength(circumcenterOffset(a, b, c))) / result.size.back());
  }
  return result;
}

namespace {

// Gives the corners of triangles in water the vertices that they will have.
class CornerVertices {
 public:
  CornerVertices(const ShoreTriangles& triangles, ShoreGraph& graph) : t_(triangles), graph_(graph) {
    corners_.reserve(mesh().triangles.size());
    for (const Triangle& t : mesh().triangles) corners_.push_back(t.v);
    const std::vector<EdgeRef> outgoing = outgoingEdges(mesh());
    for (VertexId v = 0; v < outgoing.size(); ++v)
      if (outgoing[v] != kNone && (t_.use[v] & kAround) == 0) visit(v, outgoing[v]);
  }

  VertexId at(TriId t, unsigned corner) const { return corners_[t][corner]; }

 private:
  struct Fan {
    std::vector<TriId> triangles;  // counter-clockwise
    double angle = 0.0;
    bool has_line = false;
  };

  const TriMesh& mesh() const { return t_.mesh; }
  bool isWater(TriId t) const { return mesh().regions[t] != t_.land; }

  void visit(VertexId v, EdgeRef start) {
    round_.clear();
    // Counter-clockwise: across the edge that ends in v.
    for (TriId t = triOf(start);;) {
      round_.push_back(t);
      t = triOf(mesh().triangle(t).adj[next3(mesh().cornerOf(t, v))]);
      if (t == triOf(start)) break;
    }
    std::size_t changes = 0;
    for (std::size_t i = 0; i < round_.size(); ++i)
      changes += isWater(round_[i]) != isWater(round_[(i + 1) % round_.size()]) ? 1 : 0;
    if (changes > 2) split(v);
  }

  void split(VertexId v) {
    std::size_t first = 0;
    while (isWater(round_[first]) || !isWater(round_[(first + 1) % round_.size()])) ++first;
    std::vector<Fan> fans;
    for (std::size_t i = 1; i <= round_.size(); ++i) {
      const TriId t = round_[(first + i) % round_.size()];
      if (!isWater(t)) continue;
      if (!isWater(round_[(first + i - 1) % round_.size()])) fans.emplace_back();
      Fan& fan = fans.back();
      const unsigned corner = mesh().cornerOf(t, v);
      const auto& c = mesh().triangle(t).v;
      fan.angle += angleAt(mesh().point(v), mesh().point(c[next3(corner)]), mesh().point(c[prev3(corner)]));
      fan.triangles.push_back(t);
      for (const unsigned side : {next3(corner), prev3(corner)}) {
        const EdgeRef e = edgeRef(t, side);
        fan.has_line = fan.has_line || (mesh().segment(e) != kNone && isWater(triOf(mesh().twin(e))));
      }
    }
    const auto kept = std::ranges::max_element(
        fans, [](const Fan& a, const Fan& b) { return a.has_line != b.has_line ? b.has_line : a.angle < b.angle; });
    for (auto fan = fans.begin(); fan != fans.end(); ++fan)
      if (fan != kept) copy(v, *fan);
  }

  void copy(VertexId v, const Fan& fan) {
    const Point& x = mesh().point(v);
    double least = std::numeric_limits<double>::infinity(), size = least;
    for (const TriId t : fan.triangles) {
      const unsigned corner = mesh().cornerOf(t, v);
      const auto& c = mesh().triangle(t).v;
      least =
          std::min(least, squaredDistanceToSegment(x, mesh().point(c[next3(corner)]), mesh().point(c[prev3(corner)])));
      size = std::min(size, t_.size[t]);
    }
    const double shift = std::min(kShiftOfCopies * size, kShiftOfHeight * std::sqrt(least));
    const TriId t = fan.triangles.front();
    const Point out = mesh().point(mesh().triangle(t).v[next3(mesh().cornerOf(t, v))]) - x;
    const double half = 0.5 * fan.angle, length = std::sqrt(squaredLength(out));
    const Point way{(out.x * std::cos(half) - out.y * std::sin(half)) / length,
                    (out.x * std::sin(half) + out.y * std::cos(half)) / length};
    const auto made = static_cast<VertexId>(graph_.pslg.points.size());
    graph_.pslg.points.push_back(x + shift * way);
    graph_.source.push_back(kNone);
    for (const TriId s : fan.triangles) corners_[s][mesh().cornerOf(s, v)] = made;
  }

  const ShoreTriangles& t_;
  ShoreGraph& graph_;
  std::vector<std::array<VertexId, 3>> corners_;
  std::vector<TriId> round_;
};

// Drops points that nothing uses.
void compact(ShoreGraph& graph, std::vector<bool>& used) {
  std::vector<VertexId> number(used.size(), kNone);
  VertexId count = 0;
  for (VertexId v = 0; v < used.size(); ++v) {
    if (!used[v]) continue;
    number[v] = count;
    graph.pslg.points[count] = graph.pslg.points[v];
    graph.source[count++] = graph.source[v];
  }
  graph.pslg.points.resize(count);
  graph.source.resize(count);
  for (Segment& s : graph.pslg.segments) s.a = number[s.a], s.b = number[s.b];
}

}  // namespace

ShoreGraph graphOf(const ShoreGraph& before, const ShoreTriangles& triangles) {
  const TriMesh& mesh = triangles.mesh;
  ShoreGraph graph;
  graph.pslg.points = before.pslg.points;
  graph.source = before.source;
  const CornerVertices corners(triangles, graph);
  const auto labelOf = [&](RegionId region) { return region == triangles.land ? kOutside : region; };
  const SegmentId segments = static_cast<SegmentId>(before.pslg.segments.size());
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i), back = mesh.twin(e);
      if (back == kNone || e > back) continue;
      const TriId u = triOf(back);
      const RegionId left = mesh.regions[t], right = mesh.regions[u];
      if (left == triangles.land && right == triangles.land) continue;
      const SegmentId s = mesh.segment(e) < segments ? mesh.segment(e) : kNone;
      const bool was_inner = s != kNone && !isBoundary(before.pslg.segments[s]);
      if (left == right && !was_inner) continue;
      Segment made;
      // Corners of water decide; where there is water on both sides, they are the same.
      if (left != triangles.land) {
        made.a = corners.at(t, next3(i)), made.b = corners.at(t, prev3(i));
      } else {
        const unsigned j = indexOf(back);
        made.a = corners.at(u, prev3(j)), made.b = corners.at(u, next3(j));
      }
      made.left = labelOf(left), made.right = labelOf(right);
      const bool same = left == triangles.region_was[t] && right == triangles.region_was[u];
      if (s != kNone && same) made.tag = before.pslg.segments[s].tag;
      graph.pslg.segments.push_back(made);
    }
  }
  std::vector<bool> used(graph.pslg.points.size(), false), was_used(before.pslg.points.size(), false);
  for (const Segment& s : graph.pslg.segments) used[s.a] = used[s.b] = true;
  for (const Segment& s : before.pslg.segments) was_used[s.a] = was_used[s.b] = true;
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    for (const VertexId v : mesh.triangles[t].v)
      if (v < was_used.size() && !was_used[v] && mesh.regions[t] != triangles.land) used[v] = true;
  }
  compact(graph, used);
  return graph;
}

void dropLoosePoints(ShoreGraph& graph) {
  std::vector<bool> used(graph.pslg.points.size(), false);
  for (VertexId v = 0; v < used.size(); ++v) used[v] = graph.source[v] != kNone;
  for (const Segment& s : graph.pslg.segments) used[s.a] = used[s.b] = true;
  compact(graph, used);
}

}  // namespace coastmesh
