#include "tests/support/excused_twin.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>
#include <sstream>
#include <utility>

#include "core/metric.hpp"
#include "core/predicates.hpp"

namespace coastmesh {

namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kDegree = std::numbers::pi / 180.0;

double direction(const Point& from, const Point& to) { return std::atan2(to.y - from.y, to.x - from.x); }

// The counter-clockwise angle from one direction to another, 0 to a full turn.
double turn(double from, double to) {
  const double by = std::fmod(to - from, kTurn);
  return by < 0.0 ? by + kTurn : by;
}

double length(const Point& a, const Point& b) { return std::hypot(b.x - a.x, b.y - a.y); }

// In long doubles, since the point may be a millionth of the segment's length away.
double lengthToSegment(const Point& p, const Point& a, const Point& b) {
  const long double ax = a.x, ay = a.y, x = b.x - ax, y = b.y - ay, ab = std::hypot(x, y);
  const long double along = ((p.x - ax) * x + (p.y - ay) * y) / ab;
  if (along <= 0.0L) return length(p, a);
  if (along >= ab) return length(p, b);
  return static_cast<double>(std::abs(x * (p.y - ay) - y * (p.x - ax)) / ab);
}

// True if some number of equal parts of the gap meets the bounds, which refinement takes a millionth of a degree
// stricter.
bool canBeCut(double gap, double min_angle_deg, double max_angle_deg) {
  const double least = min_angle_deg > 0.0 ? (min_angle_deg + 1e-6) * kDegree : 0.0;
  const double most =
      std::min(max_angle_deg < 180.0 ? max_angle_deg - 1e-6 : 180.0, 180.0 - 2.0 * least / kDegree) * kDegree;
  for (int pieces = 1; pieces <= 8; ++pieces)
    if (gap >= pieces * least - 1e-9 && gap <= (pieces + 1e-9) * most) return true;
  return false;
}

std::array<double, 3> anglesOf(const TriMesh& mesh, TriId t) {
  std::array<double, 3> angles{};
  for (unsigned i = 0; i < 3; ++i) {
    const auto& v = mesh.triangles[t].v;
    const Point &p = mesh.points[v[i]], &q = mesh.points[v[(i + 1) % 3]], &r = mesh.points[v[(i + 2) % 3]];
    angles[i] = turn(direction(p, q), direction(p, r)) / kDegree;
  }
  return angles;
}

Point centreOf(const TriMesh& mesh, TriId t) {
  const auto& v = mesh.triangles[t].v;
  return (1.0 / 3.0) * (mesh.points[v[0]] + mesh.points[v[1]] + mesh.points[v[2]]);
}

}  // namespace

bool ExcusedTwin::fills(TriId t, VertexId apex, double from, double gap) const {
  const auto& v = mesh_.triangles[t].v;
  Point way;  // to the triangle's centroid
  for (const VertexId w : v) way = way + (mesh_.points[w] - mesh_.points[apex]);
  return std::ranges::find(v, apex) != v.end() && turn(from, direction({}, way)) < gap;
}

ExcusedTwin::ExcusedTwin(const TriMesh& mesh, const Pslg& pslg, double min_angle_deg, double max_angle_deg)
    : mesh_(mesh) {
  // The input that is in the mesh. `ways`: the directed constraints that have triangles to their left. An input of
  // points alone has a boundary without segments.
  std::set<std::pair<VertexId, VertexId>> walls, ways;
  std::set<VertexId> used;
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    const Triangle& tri = mesh.triangles[t];
    for (unsigned i = 0; i < 3; ++i) {
      if (tri.v[i] < pslg.points.size()) used.insert(tri.v[i]);
      if (tri.seg[i] == kNone && tri.adj[i] != kNone) continue;
      VertexId a = tri.v[(i + 1) % 3], b = tri.v[(i + 2) % 3];
      if (tri.seg[i] != kNone) {
        const Segment& whole = pslg.segments[tri.seg[i]];
        const Point along = mesh.points[b] - mesh.points[a], way = mesh.points[whole.b] - mesh.points[whole.a];
        const bool same = along.x * way.x + along.y * way.y > 0.0;
        a = same ? whole.a : whole.b;
        b = same ? whole.b : whole.a;
      }
      ways.emplace(a, b);
      walls.insert(std::minmax(a, b));
    }
  }
  std::map<VertexId, std::vector<std::pair<double, VertexId>>> directions;
  for (const auto& [a, b] : walls) {
    directions[a].emplace_back(direction(mesh.points[a], mesh.points[b]), b);
    directions[b].emplace_back(direction(mesh.points[b], mesh.points[a]), a);
  }
  for (auto& [apex, out] : directions) {
    std::ranges::sort(out);
    // Directions that are equal in double precision.
    constexpr double kSame = 1e-12;
    for (std::size_t k = 0; k + 1 < out.size(); ++k)
      if (out[k + 1].first - out[k].first < kSame &&
          orient2d(mesh.points[apex], mesh.points[out[k].second], mesh.points[out[k + 1].second]) < 0)
        std::swap(out[k], out[k + 1]);
    for (std::size_t k = 0; k < out.size(); ++k) {
      double gap = turn(out[k].first, out[(k + 1) % out.size()].first);
      if (gap > kTurn - kSame && out.size() > 1) gap = 0.0;
      if (out.size() == 1 || gap > std::numbers::pi - 1e-6 || canBeCut(gap, min_angle_deg, max_angle_deg)) continue;
      if (!ways.contains({apex, out[k].second})) continue;
      double size = std::numeric_limits<double>::infinity();
      const Point& here = mesh.points[apex];
      for (const VertexId v : used)
        if (v != apex) size = std::min(size, length(here, mesh.points[v]));
      for (const auto& [a, b] : walls)
        if (a != apex && b != apex) size = std::min(size, lengthToSegment(here, mesh.points[a], mesh.points[b]));
      corners_.push_back({apex, out[k].first, gap, size});
    }
  }
}

Excuse ExcusedTwin::excuseOf(TriId t) const {
  Excuse excuse = Excuse::None;
  for (const Corner& corner : corners_) {
    if (fills(t, corner.apex, corner.from, corner.gap)) return Excuse::Corner;
    double farthest = 0.0;
    for (const VertexId v : mesh_.triangles[t].v)
      farthest = std::max(farthest, length(mesh_.points[v], mesh_.points[corner.apex]));
    if (farthest <= corner.size * (1.0 + 1e-9)) excuse = Excuse::Near;
  }
  return excuse;
}

std::string wrongBoundViolations(const TriMesh& mesh, const Pslg& pslg, const RefineOptions& options,
                                 const std::vector<BoundViolation>& listed) {
  constexpr double kHair = 1e-5;  // degrees, or hundredths of the longest edge allowed
  // Because of rounding, thinner triangles may lie on both sides of their bounds.
  constexpr double kThin = 1e-6;
  std::multiset<std::pair<double, double>> places;
  for (const BoundViolation& s : listed) places.emplace(s.place.x, s.place.y);
  std::ostringstream wrong;
  wrong.precision(17);
  const ExcusedTwin twin(mesh, pslg, options.min_angle_deg, options.max_angle_deg);
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t].v;
    const std::array<double, 3> angles = anglesOf(mesh, t);
    double by = options.min_angle_deg - std::ranges::min(angles);
    if (options.max_angle_deg < 180.0) by = std::max(by, std::ranges::max(angles) - options.max_angle_deg);
    for (unsigned i = 0; i < 3; ++i)
      by = std::max(by, 100.0 * (length(mesh.points[v[i]], mesh.points[v[(i + 1) % 3]]) / options.size_max - 1.0));
    const Point centre = centreOf(mesh, t);
    const auto place = places.find({centre.x, centre.y});
    const bool is_listed = place != places.end();
    if (is_listed) places.erase(place);
    if ((by < -kHair && !is_listed) || std::ranges::min(angles) < kThin || std::ranges::max(angles) > 180.0) continue;
    const bool excused = twin.excuseOf(t) != Excuse::None;
    if (is_listed ? by < -kHair || excused : by > kHair && !excused)
      wrong << "triangle " << t << " at " << centre.x << ", " << centre.y << " is short by " << by
            << (excused ? ", excused" : ", not excused") << (is_listed ? ", listed\n" : ", not listed\n");
  }
  for (const auto& [x, y] : places) wrong << "no triangle is at " << x << ", " << y << '\n';
  return wrong.str();
}

}  // namespace coastmesh
