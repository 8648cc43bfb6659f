#include "core/refine/check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "core/metric.hpp"
#include "core/predicates.hpp"
#include "core/refine/bound_violations.hpp"
#include "core/refine/check_input.hpp"

namespace coastmesh {

namespace {

Point centroid(const TriMesh& mesh, TriId t) {
  const auto& v = mesh.triangles[t].v;
  return (1.0 / 3.0) * (mesh.points[v[0]] + mesh.points[v[1]] + mesh.points[v[2]]);
}

bool hasValidCorners(const TriMesh& mesh, TriId t) {
  const auto& v = mesh.triangles[t].v;
  return std::ranges::all_of(v, [&](VertexId c) { return c < mesh.points.size(); }) && v[0] != v[1] && v[1] != v[2] &&
         v[2] != v[0];
}

bool hasValidNeighbours(const TriMesh& mesh, TriId t) {
  for (unsigned i = 0; i < 3; ++i) {
    const EdgeRef e = edgeRef(t, i), twin = mesh.triangles[t].adj[i];
    if (twin == kNone) continue;
    if (triOf(twin) >= mesh.triangles.size() || indexOf(twin) > 2) return false;
    if (mesh.twin(twin) != e || mesh.origin(twin) != mesh.target(e) || mesh.target(twin) != mesh.origin(e))
      return false;
    if (mesh.segment(twin) != mesh.segment(e)) return false;
  }
  return true;
}

using Defects = std::vector<MeshDefect>;

// Appends what `find(i, defects)` finds for every i below `count`, in that order.
template <typename Find>
void findDefects(std::size_t count, const ItemLoop& loop, Defects& defects, const Find& find) {
  const Defects found = joined(overStretches(loop, count, [&](std::size_t first, std::size_t last) {
    Defects here;
    for (std::size_t i = first; i < last; ++i) find(static_cast<std::uint32_t>(i), here);
    return here;
  }));
  defects.insert(defects.end(), found.begin(), found.end());
}

void checkTopology(const TriMesh& mesh, const ItemLoop& loop, Defects& defects) {
  findDefects(mesh.triangles.size(), loop, defects, [&](TriId t, Defects& found) {
    if (!hasValidCorners(mesh, t)) {
      found.push_back({DefectKind::BrokenTopology, {}, t});
    } else if (!hasValidNeighbours(mesh, t)) {
      found.push_back({DefectKind::BrokenTopology, centroid(mesh, t), t});
    }
  });
}

// Height of a triangle over its longest edge, as a share of that, seen from outside of a surface around the origin;
// above 0 if the corners are counter-clockwise.
double heightOutside(const SpacePoint& a, const SpacePoint& b, const SpacePoint& c) {
  const SpacePoint ab = b - a, ac = c - a, bc = c - b;
  return dot(a, cross(ab, ac)) / (lengthOf(a) * std::max({dot(ab, ab), dot(ac, ac), dot(bc, bc)}));
}

void checkOrientation(const TriMesh& mesh, const CheckOptions& options, const ItemLoop& loop, Defects& defects) {
  // In space rounding inverts slivers: the exact test in the plane decides.
  constexpr double kSliver = 1e-5;
  findDefects(mesh.triangles.size(), loop, defects, [&](TriId t, Defects& found) {
    const auto& v = mesh.triangles[t].v;
    const std::span<const SpacePoint> places = options.places;
    const double height = options.closed ? heightOutside(places[v[0]], places[v[1]], places[v[2]]) : 0.0;
    const bool is_right = std::abs(height) > kSliver
                              ? height > 0.0
                              : orient2d(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]) > 0;
    if (!is_right) found.push_back({DefectKind::NotCounterClockwise, centroid(mesh, t), t});
  });
}

// A vertex is pinched if the fan from its outgoing edge does not contain all of its triangles.
void checkPinches(const TriMesh& mesh, std::vector<MeshDefect>& defects) {
  const std::vector<EdgeRef> out = outgoingEdges(mesh);
  std::vector<std::uint32_t> triangles_at(mesh.points.size(), 0);
  for (const Triangle& t : mesh.triangles)
    for (const VertexId v : t.v) ++triangles_at[v];
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    if (out[v] == kNone) continue;
    std::uint32_t seen = 0;
    for (EdgeRef e = out[v];;) {
      ++seen;
      const EdgeRef in = edgeRef(triOf(e), prev3(indexOf(e)));
      e = mesh.twin(in);
      if (e == kNone || e == out[v] || seen > triangles_at[v]) break;
    }
    if (seen != triangles_at[v]) defects.push_back({DefectKind::PinchedVertex, mesh.points[v], triOf(out[v])});
  }
}

bool isTurnedOver(const TriMesh& mesh, TriId t) {
  const auto& v = mesh.triangles[t].v;
  return orient2d(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]) <= 0;
}

void checkDelaunay(const TriMesh& mesh, const CheckOptions& options, const ItemLoop& loop, Defects& defects) {
  // Coordinates from a file or a projection are rounded, so that cocircular points need a tolerance.
  const bool exact = mesh.input_vertices != 0;
  constexpr double kRoundingRad = 1e-7;
  findDefects(mesh.triangles.size(), loop, defects, [&](TriId t, Defects& found) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i), twin = mesh.twin(e);
      if (twin == kNone || twin < e || mesh.segment(e) != kNone) continue;
      const Point &a = mesh.points[mesh.apex(e)], &b = mesh.points[mesh.origin(e)], &c = mesh.points[mesh.target(e)],
                  &d = mesh.points[mesh.apex(twin)];
      if (inCircle(a, b, c, d) <= 0) continue;
      if (options.closed && (isTurnedOver(mesh, t) || isTurnedOver(mesh, triOf(twin)))) continue;
      if (!exact && angleAt(a, b, c) + angleAt(d, b, c) < std::numbers::pi + kRoundingRad) continue;
      found.push_back({DefectKind::NotDelaunay, midpoint(b, c), t});
    }
  });
}

void checkUnused(const TriMesh& mesh, std::span<const std::uint8_t> used, const ItemLoop& loop, Defects& defects) {
  const VertexId first = std::min(mesh.input_vertices, static_cast<VertexId>(mesh.points.size()));
  findDefects(mesh.points.size() - first, loop, defects, [&](std::uint32_t i, Defects& found) {
    if (!used[first + i]) found.push_back({DefectKind::UnusedVertex, mesh.points[first + i]});
  });
}

BoundCounts checkBounds(const TriMesh& mesh, const CheckOptions& options, const ItemLoop& loop, Defects& defects) {
  if (options.min_angle_deg <= 0.0 && options.max_angle_deg >= 180.0) return {};
  constexpr double kAnySize = std::numeric_limits<double>::infinity();
  const BoundJudgement judgement =
      judgeFinished(mesh, options.min_angle_deg, options.max_angle_deg, kAnySize, 0.0, loop, {}, options.places);
  for (const BoundViolation& s : judgement.unresolved)
    defects.push_back({DefectKind::AngleBelowBound, s.place, kNone, s.min_angle_deg});
  return judgement.counts;
}

}  // namespace

std::vector<MeshDefect> checkMesh(const TriMesh& mesh, const Pslg* pslg, const CheckOptions& options,
                                  const ItemLoop& loop, BoundCounts* bounds) {
  Defects defects;
  BoundCounts ignored;
  BoundCounts& counts = bounds != nullptr ? *bounds : ignored;
  counts = {};
  checkTopology(mesh, loop, defects);
  if (!defects.empty()) return defects;  // the other checks need a consistent mesh
  checkOrientation(mesh, options, loop, defects);
  const BulkList<std::uint8_t> used = usedVertices(mesh, loop);
  checkUnused(mesh, used, loop, defects);
  if (options.pinches) checkPinches(mesh, defects);
  if (pslg != nullptr && mesh.input_vertices == 0 && !pslg->points.empty()) {
    TriMesh marked = mesh;
    checkAgainstInputByPlace(marked, *pslg, defects);
    if (options.delaunay) checkDelaunay(marked, options, loop, defects);
    counts = checkBounds(marked, options, loop, defects);
    return defects;
  }
  if (pslg != nullptr) checkAgainstInput(mesh, used, *pslg, options.cover, loop, defects);
  if (options.delaunay) checkDelaunay(mesh, options, loop, defects);
  counts = checkBounds(mesh, options, loop, defects);
  return defects;
}

}  // namespace coastmesh
