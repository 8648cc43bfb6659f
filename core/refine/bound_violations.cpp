#include "core/refine/bound_violations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/quality.hpp"

namespace coastmesh {

namespace {

std::array<Point, 3> cornersOf(const TriMesh& mesh, TriId t) {
  const auto& v = mesh.triangles[t].v;
  return {mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]};
}

bool isBadInSpace(const SpacePoint& a, const SpacePoint& b, const SpacePoint& c, const AngleBound& bound) {
  if (bound.min_angle <= 0.0 && bound.max_angle >= std::numbers::pi) return false;
  // Clear of the bounds without an arc tangent, as nearly all triangles are: by twice the area times the cotangents.
  constexpr double kClear = 1.0 - 1e-9;
  const SpacePoint ab = b - a, bc = c - b, ca = a - c;
  const double twice_area = lengthOf(cross(ab, bc));
  const auto [least, most] = std::ranges::minmax({-dot(ab, ca), -dot(ab, bc), -dot(bc, ca)});
  const double steepest = bound.max_angle >= std::numbers::pi ? -std::numeric_limits<double>::infinity()
                                                              : bound.cos_max / std::sin(bound.max_angle);
  if (most < kClear * bound.cot_min * twice_area && least > steepest * twice_area + (1.0 - kClear) * most) return false;
  const auto [low, high] = std::ranges::minmax(spaceAnglesDeg(a, b, c));
  return low < toDegrees(bound.min_angle) || high > toDegrees(bound.max_angle);
}

// Tests triangles against bounds; angles are those between `places`, one for each point of the mesh, if given.
class BoundTest {
 public:
  BoundTest(const TriMesh& mesh, const TriangleBound& bound, std::span<const SpacePoint> places)
      : mesh_(mesh), bound_(bound), angles_(bound), lengths_(bound), places_(places) {
    angles_.squared_size = std::numeric_limits<double>::infinity();
    angles_.size = nullptr;
    static_cast<AngleBound&>(lengths_) = AngleBound(0.0, 180.0);
  }

  bool breaksAngles(TriId t) const {
    if (places_.empty()) return isBadBy(t, angles_);
    const auto& v = mesh_.triangles[t].v;
    return isBadInSpace(places_[v[0]], places_[v[1]], places_[v[2]], bound_);
  }
  bool breaksAny(TriId t) const {
    if (places_.empty()) return isBadBy(t, bound_);
    return breaksAngles(t) || (!std::isinf(bound_.squared_size) && isBadBy(t, lengths_));
  }

 private:
  bool isBadBy(TriId t, const TriangleBound& bound) const {
    const auto [a, b, c] = cornersOf(mesh_, t);
    return isBad(a, b, c, bound);
  }

  const TriMesh& mesh_;
  const TriangleBound& bound_;
  TriangleBound angles_, lengths_;  // each alone
  std::span<const SpacePoint> places_;
};

std::vector<TriId> badTriangles(const TriMesh& mesh, const BoundTest& test, const ItemLoop& loop) {
  return joined(overStretches(loop, mesh.triangles.size(), [&](std::size_t first, std::size_t last) {
    std::vector<TriId> some;
    for (auto t = static_cast<TriId>(first); t < last; ++t)
      if (test.breaksAny(t)) some.push_back(t);
    return some;
  }));
}

}  // namespace

std::vector<TriId> trianglesInViolation(const TriMesh& mesh, const RefineOptions& options, const InputCorners* corners,
                                        const ItemLoop& loop) {
  const TriangleBound bound = strictBoundOf(options);
  std::vector<TriId> bad = badTriangles(mesh, BoundTest(mesh, bound, {}), loop);
  if (corners == nullptr) return bad;
  std::erase_if(bad, [&](TriId t) {
    const auto [a, b, c] = cornersOf(mesh, t);
    return corners->excuseOf(a, b, c) != Excuse::None;
  });
  return bad;
}

std::vector<BoundViolation> findBoundViolations(const TriMesh& mesh, const RefineOptions& options,
                                                const ItemLoop& loop) {
  const TriangleBound bound = strictBoundOf(options);
  return judgeBounds(mesh, bound, bound, loop).unresolved;
}

BoundJudgement judgeBounds(const TriMesh& mesh, const TriangleBound& asked, const TriangleBound& in_reach,
                           const ItemLoop& loop, std::span<const SpacePoint> places) {
  const BoundTest test(mesh, asked, places);
  const std::vector<TriId> bad = badTriangles(mesh, test, loop);
  if (bad.empty()) return {};
  const InputCorners corners(mesh, in_reach, loop);
  BoundJudgement judgement;
  for (const TriId t : bad) {
    const auto [a, b, c] = cornersOf(mesh, t);
    const Excuse excuse = corners.excuseOf(a, b, c);
    if (test.breaksAngles(t)) judgement.counts.add(excuse);
    if (excuse != Excuse::None) continue;
    const auto& v = mesh.triangles[t].v;
    const auto [low, high] =
        std::ranges::minmax(places.empty() ? surfaceAnglesDeg(a, b, c, asked.surface)
                                           : spaceAnglesDeg(places[v[0]], places[v[1]], places[v[2]]));
    judgement.unresolved.push_back({(1.0 / 3.0) * (a + b + c), low, high});
  }
  return judgement;
}

BoundJudgement judgeFinished(const TriMesh& mesh, double min_angle_deg, double max_angle_deg, double size_max,
                             double slack_deg, const ItemLoop& loop, const Surface& surface,
                             std::span<const SpacePoint> places) {
  // Corners as in refinement: its slightly stricter bounds cannot divide an input angle of exactly the bound.
  const double hair = 2.0 * TriangleBound::kMarginDeg + slack_deg;
  TriangleBound asked(std::max(0.0, min_angle_deg - hair), std::min(180.0, max_angle_deg + hair), size_max);
  asked.surface = surface;
  return judgeBounds(mesh, asked, TriangleBound(min_angle_deg, max_angle_deg, size_max), loop, places);
}

}  // namespace coastmesh
