#include "tests/fuzz/edge_pslgs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "core/metric.hpp"
#include "core/tri_mesh.hpp"
#include "core/triangulate/delaunay.hpp"

namespace coastmesh {

namespace {

Point onGrid(Choices& choices, std::uint32_t cells) {
  const double x = choices.below(cells);
  return {x, static_cast<double>(choices.below(cells))};
}

Point inSquare(Choices& choices) {
  const double x = choices.share();
  return {x, choices.share()};
}

Point onCircle(Choices& choices) {
  const double at = 2.0 * std::numbers::pi * (choices.oneIn(2) ? choices.below(24) / 24.0 : choices.share());
  return {std::cos(at), std::sin(at)};
}

Point onLines(Choices& choices) {
  const double along = choices.oneIn(2) ? choices.below(16) / 16.0 : choices.share();
  const double across = choices.below(4) * (choices.oneIn(4) ? 0.25 : 1e-3);
  return {along, across};
}

// Near an existing point, at distances down to a millionth, or anywhere.
Point inClusters(Choices& choices, const std::vector<Point>& points) {
  const Point p = inSquare(choices);
  if (points.empty() || choices.oneIn(3)) return p;
  const Point& near = points[choices.below(static_cast<std::uint32_t>(points.size()))];
  return near + std::pow(10.0, -1.0 - choices.below(6)) * (p - Point{0.5, 0.5});
}

std::vector<Point> randomPoints(Choices& choices) {
  const std::uint32_t style = choices.below(6), cells = 2 + choices.below(12);
  const std::uint32_t count = 3 + choices.below(choices.oneIn(8) ? 80 : 24);
  std::vector<Point> points;
  for (std::uint32_t i = 0; i < count; ++i) {
    switch (style) {
      case 0:
        points.push_back(onGrid(choices, cells));
        break;
      case 1:
        points.push_back(inSquare(choices));
        break;
      case 2:
        points.push_back(onCircle(choices));
        break;
      case 3:
        points.push_back(onLines(choices));
        break;
      case 4:
        points.push_back(inClusters(choices, points));
        break;
      default:
        points.push_back(choices.oneIn(2) ? onGrid(choices, cells) : static_cast<double>(cells) * inSquare(choices));
    }
  }
  return points;
}

double nudged(Choices& choices, double x) {
  const std::uint32_t how = choices.below(9);
  if (how == 0) return x;
  const double sign = choices.oneIn(2) ? -1.0 : 1.0;
  if (how == 1) return std::nextafter(x, sign * std::numeric_limits<double>::infinity());
  if (how == 2) return x + sign * 4.0 * std::numeric_limits<double>::epsilon() * std::abs(x);
  return x + sign * std::pow(10.0, -1.0 - how);
}

void addNearDuplicates(Choices& choices, std::vector<Point>& points) {
  const std::uint32_t count = choices.oneIn(3) ? 1 + choices.below(5) : 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const Point near = points[choices.below(static_cast<std::uint32_t>(points.size()))];
    const double x = nudged(choices, near.x);
    points.push_back({x, nudged(choices, near.y)});
  }
}

class Components {
 public:
  explicit Components(std::size_t n) : parent_(n) {
    for (std::size_t i = 0; i < n; ++i) parent_[i] = static_cast<VertexId>(i);
  }
  VertexId find(VertexId v) {
    while (parent_[v] != v) v = parent_[v] = parent_[parent_[v]];
    return v;
  }
  bool join(VertexId a, VertexId b) {
    a = find(a), b = find(b);
    parent_[a] = b;
    return a != b;
  }

 private:
  std::vector<VertexId> parent_;
};

std::vector<EdgeRef> edgesOf(const TriMesh& mesh) {
  std::vector<EdgeRef> edges;
  for (TriId t = 0; t < mesh.triangles.size(); ++t)
    for (unsigned i = 0; i < 3; ++i)
      if (mesh.twin(edgeRef(t, i)) == kNone || edgeRef(t, i) < mesh.twin(edgeRef(t, i))) edges.push_back(edgeRef(t, i));
  return edges;
}

void addSegment(Choices& choices, Pslg& pslg, const TriMesh& mesh, EdgeRef e, RegionId left, RegionId right) {
  VertexId a = mesh.origin(e), b = mesh.target(e);
  if (choices.oneIn(3)) {
    std::swap(a, b);
    std::swap(left, right);
  }
  pslg.segments.push_back({a, b, static_cast<std::int32_t>(pslg.segments.size() + 1), left, right});
}

Point centroid(const TriMesh& mesh, TriId t) {
  const auto& v = mesh.triangle(t).v;
  return (1.0 / 3.0) * (mesh.point(v[0]) + mesh.point(v[1]) + mesh.point(v[2]));
}

void addUnlabelled(Choices& choices, Pslg& pslg, const TriMesh& mesh) {
  const bool whole_boundary = !choices.oneIn(4);
  const std::uint32_t one_in = 1 + choices.below(6);
  for (const EdgeRef e : edgesOf(mesh)) {
    const bool boundary = mesh.twin(e) == kNone;
    if ((boundary && whole_boundary) || choices.oneIn(one_in))
      addSegment(choices, pslg, mesh, e, kUnlabelled, kUnlabelled);
  }
  const std::uint32_t holes = choices.below(3);
  for (std::uint32_t i = 0; i < holes; ++i)
    pslg.holes.push_back(centroid(mesh, choices.below(static_cast<std::uint32_t>(mesh.triangles.size()))));
}

// A region for each triangle: random ones, or blobs that grow from a few triangles.
std::vector<RegionId> randomRegions(Choices& choices, const TriMesh& mesh) {
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  std::vector<RegionId> regions(count, kOutside);
  if (choices.oneIn(3)) {
    for (RegionId& r : regions) r = static_cast<RegionId>(choices.below(4)) - 1;
    return regions;
  }
  if (choices.oneIn(2)) std::ranges::fill(regions, 0);
  const std::uint32_t blobs = 1 + choices.below(4);
  for (std::uint32_t i = 0; i < blobs; ++i) {
    const RegionId region = static_cast<RegionId>(choices.below(3)) - 1;
    TriId at = choices.below(count);
    const std::uint32_t size = choices.below(20);
    for (std::uint32_t step = 0; step < size; ++step) {
      regions[at] = region;
      const EdgeRef across = mesh.triangle(at).adj[choices.below(3)];
      if (across != kNone) at = triOf(across);
    }
  }
  return regions;
}

void addLabelled(Choices& choices, Pslg& pslg, const TriMesh& mesh) {
  const std::vector<RegionId> regions = randomRegions(choices, mesh);
  const std::uint32_t one_in = 1 + choices.below(12);
  Components components(mesh.points.size());
  std::vector<std::pair<EdgeRef, RegionId>> inner;
  for (const EdgeRef e : edgesOf(mesh)) {
    const EdgeRef twin = mesh.twin(e);
    const RegionId left = regions[triOf(e)], right = twin == kNone ? kOutside : regions[triOf(twin)];
    if (left == right) {
      inner.emplace_back(e, left);
      continue;
    }
    addSegment(choices, pslg, mesh, e, left, right);
    components.join(mesh.origin(e), mesh.target(e));
  }
  for (const auto& [e, region] : inner) {
    if (one_in == 1 || !choices.oneIn(one_in)) continue;
    // Only open lines may be unlabelled: unlabelled segments must not close a ring.
    const bool open = components.join(mesh.origin(e), mesh.target(e));
    const RegionId label = open && region >= 0 && choices.oneIn(2) ? kUnlabelled : region;
    addSegment(choices, pslg, mesh, e, label, label);
  }
}

}  // namespace

Pslg edgePslg(Choices& choices, const Placement& placement) {
  Pslg pslg;
  const bool labelled = choices.oneIn(2);
  pslg.points = randomPoints(choices);
  addNearDuplicates(choices, pslg.points);
  for (Point& p : pslg.points) p = placement(p);
  // In the order drawn, without repeated points.
  std::vector<Point> distinct;
  for (const Point& p : pslg.points)
    if (std::ranges::find(distinct, p) == distinct.end()) distinct.push_back(p);
  pslg.points = std::move(distinct);
  TriMesh mesh;
  try {
    mesh = constrainedDelaunay(pslg);
  } catch (const BadPslg&) {
    return pslg;  // all on one line
  }
  if (labelled) {
    addLabelled(choices, pslg, mesh);
  } else if (!choices.oneIn(8)) {
    addUnlabelled(choices, pslg, mesh);
  }
  return pslg;
}

}  // namespace coastmesh
