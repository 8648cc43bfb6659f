#include "core/refine/steiner.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace coastmesh {

namespace {

constexpr double kInverseRootOfThree = 0.57735026918962576;

// Radius of the petal of a shortest edge of length `length`: Definition 1 with its erratum, |pq| / (2 sin alpha). If
// the triangle is only too long, at most the circumradius of an equilateral triangle of the maximum edge; if lengths
// are requested, always at most that of the requested length, so that new edges come close to it. At most the
// triangle's own circumradius, whose circle contains no vertex.
double petalRadius(double length, double circumradius, double wanted, const TriangleBound& bound, double sin_place,
                   bool bad_angle) {
  double radius = circumradius;
  if (bound.min_angle > 0.0) radius = std::min(radius, 0.5 * length / sin_place);
  if (bound.size != nullptr) {
    radius = std::min(radius, kInverseRootOfThree * wanted);
  } else if (!bad_angle) {
    radius = std::min(radius, kInverseRootOfThree * std::sqrt(bound.squared_size));
  }
  return std::max(radius, 0.5 * length);
}

// The petal of an edge on a sphere is a cap, whose boundary sees the edge under one angle. In the frame at one end,
// where the edge has this length, it is a disk, whose boundary sees it under another. Returns the sine of that; 0 if
// the cap would exceed half the sphere. The angle includes the surface's margin for the longest edge of a triangle in
// the petal, its diameter; otherwise every point on the petal's boundary would make a bad triangle.
double sineInFrame(double sine, double length, const AngleBound& angles, const Surface& surface) {
  if (!surface.isCurved()) return sine;
  const double stricter = sine + angles.cos_min * surface.margin * length / sine;
  const double squared_tangent = surface.curvature * length * length;  // of half the arc
  return std::sqrt(std::max(0.0, stricter * stricter * (1.0 + squared_tangent) - squared_tangent));
}

// Squared clearances that differ by less than this factor count as equal, and a hash of the place chooses, as rounding
// does between the places of a lattice in the plane. Otherwise one side would always win on a sphere, and refinement at
// a lattice's edge would spread through all of it.
double evenAt(const Point& place) {
  constexpr double kSame = 1e-5;
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(place.x) ^ std::bit_cast<std::uint64_t>(place.y);
  return (bits >> 8 & 1) != 0 ? 1.0 + kSame : 1.0 - kSame;
}

// Far more Voronoi edges than a petal has; a limit for meshes distorted by rounding.
constexpr int kMostSteps = 10000;

}  // namespace

SteinerPoint SteinerSearch::find(const EditMesh& mesh, TriId t, unsigned apex) {
  // All geometry relative to p, on a sphere in the frame there.
  const Triangle& bad = mesh.triangle(t);
  const Point& p = mesh.point(bad.v[next3(apex)]);
  const Frame frame(bound_.surface, p);
  const auto relative = [&](VertexId v) { return frame.relative(mesh.point(v)); };
  const auto clearance = [&](const Point& place, const Point& vertex) {
    const double squared = squaredDistance(place, vertex);
    return frame.isCurved() ? squared * frame.shrinkAt(place) * frame.shrinkAt(vertex) : squared;
  };
  const Point q = relative(bad.v[prev3(apex)]);
  const Point r = relative(bad.v[apex]);
  if (frame.isCurved() && !(cross(q, r) > 0.0)) {
    // Its circumcircle contains the far end of the sphere.
    const Point centre = centroid(p, mesh.point(bad.v[prev3(apex)]), mesh.point(bad.v[apex]));
    double nearest = bound_.surface.squaredChord(centre, p);
    for (const unsigned other : {prev3(apex), apex})
      nearest = std::min(nearest, bound_.surface.squaredChord(centre, mesh.point(bad.v[other])));
    return {centre, SteinerType::OwnCircumcenter, t, nearest};
  }
  const Point own = circumcenterOffset({}, q, r);
  const double own_clearance = clearance(own, {});
  if (algorithm_ == Algorithm::Circumcenter)
    return {frame.absolute(own), SteinerType::OwnCircumcenter, t, own_clearance};

  const double length = std::sqrt(squaredLength(q));
  const bool bad_angle = isSmallestAngleBelow({}, q, r, bound_.cot_min);
  const Point normal{-q.y / length, q.x / length};
  // The length at the centroid of the equilateral triangle on pq: with that at pq itself, edges come out too short
  // where lengths grow away from it, as beside every shore.
  const Point centre = 0.5 * q + 0.5 * kInverseRootOfThree * Point{-q.y, q.x};
  const double wanted = bound_.size == nullptr ? 0.0 : scale_ * bound_.size->at(frame.absolute(centre));
  // On the circumcircle itself, rounding decides whether a point removes the triangle, which would not be tried again
  // if its angles are good enough. Where vertices move as well, such triangles do not last.
  constexpr double kClearlyInside = 1.0 - 1e-6;
  const bool stays_inside = algorithm_ == Algorithm::Optimal && !bad_angle;
  const double circumradius = std::sqrt(squaredLength(own));
  const double radius = petalRadius(length, stays_inside ? kClearlyInside * circumradius : circumradius, wanted, bound_,
                                    sineInFrame(sin_place_, length, bound_, bound_.surface), bad_angle);
  const double height = std::sqrt(std::max(0.0, radius * radius - 0.25 * length * length));
  // Type I if the circumcentre is outside the petal; both are on the bisector of pq.
  if (dot(normal, own) > height + radius) {
    const Point tip = 0.5 * q + (height + radius) * normal;
    return {frame.absolute(tip), SteinerType::DualOfShortestEdge, t, clearance(tip, {})};
  }
  SteinerPoint best{own, SteinerType::OwnCircumcenter, t, own_clearance};
  if (algorithm_ != Algorithm::Offcenter) {
    // Follows the Voronoi edges inside the petal, from the bad triangle's circumcentre. No vertex lies in the petal, so
    // they form a tree: a cycle would enclose a whole Voronoi cell with its vertex.
    const Point middle = 0.5 * q + height * normal;  // of the petal
    const double squared_radius = radius * radius;
    const auto offer = [&](const Point& place, SteinerType type, TriId near, double squared_clearance) {
      const double even = frame.isCurved() ? evenAt(place) : 1.0;
      if (squared_clearance > even * best.squared_clearance) best = {place, type, near, squared_clearance};
    };
    steps_.clear();
    steps_.push_back({edgeRef(t, prev3(apex)), own});
    steps_.push_back({edgeRef(t, next3(apex)), own});
    for (int steps = 0; !steps_.empty() && steps < kMostSteps; ++steps) {
      const auto [edge, from] = steps_.back();
      steps_.pop_back();
      // Voronoi edges towards a constraint lead to places that are nearer to its ends, or behind it.
      if (mesh.isConstrained(edge)) continue;
      const EdgeRef beyond = mesh.twin(edge);
      const Point u = relative(mesh.origin(edge)), w = relative(mesh.target(edge));
      const Point apex_point = relative(mesh.apex(beyond));
      const Point to = u + circumcenterOffset(u, apex_point, w);
      if (squaredDistance(to, middle) <= squared_radius) {
        offer(to, SteinerType::OtherCircumcenter, triOf(beyond), clearance(to, u));
        steps_.push_back({edgeRef(triOf(beyond), prev3(indexOf(beyond))), to});
        steps_.push_back({edgeRef(triOf(beyond), next3(indexOf(beyond))), to});
      } else {
        // Where the Voronoi edge leaves the petal.
        const Point offset = from - middle, along = to - from;
        const double a = squaredLength(along), b = dot(along, offset), c = squaredLength(offset) - squared_radius;
        const Point exit = from + ((-b + std::sqrt(std::max(0.0, b * b - a * c))) / a) * along;
        if (!std::isfinite(exit.x) || !std::isfinite(exit.y)) continue;
        offer(exit, SteinerType::OtherVoronoiEdge, triOf(beyond), clearance(exit, u));
      }
    }
  }
  best.place = frame.absolute(best.place);
  return best;
}

}  // namespace coastmesh
