#include "core/quality.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <vector>

#include "core/metric.hpp"

namespace coastmesh {

std::array<double, 3> anglesDeg(const Point& a, const Point& b, const Point& c) {
  return {toDegrees(angleAt(a, b, c)), toDegrees(angleAt(b, c, a)), toDegrees(angleAt(c, a, b))};
}

// The smallest angle has the largest scalar product of its sides.
double leastAngleDeg(const Point& a, const Point& b, const Point& c) {
  const Point ab = b - a, bc = c - b, ca = a - c;
  const double at_a = -dot(ab, ca), at_b = -dot(ab, bc), at_c = -dot(bc, ca);
  if (at_a >= at_b && at_a >= at_c) return toDegrees(angleAt(a, b, c));
  return toDegrees(at_b >= at_c ? angleAt(b, c, a) : angleAt(c, a, b));
}

namespace {

// Products of sides, of which the smallest is at the largest angle. Never the negative zero that corners at one place
// have: its angle would be 180° at every corner.
std::array<double, 3> cornerProducts(const SpacePoint& ab, const SpacePoint& bc, const SpacePoint& ca) {
  return {0.0 - dot(ab, ca), 0.0 - dot(ab, bc), 0.0 - dot(bc, ca)};
}

}  // namespace

std::array<double, 3> spaceAnglesDeg(const SpacePoint& a, const SpacePoint& b, const SpacePoint& c) {
  const SpacePoint ab = b - a, bc = c - b, ca = a - c;
  const double twice_area = lengthOf(cross(ab, bc));
  const std::array<double, 3> cosines = cornerProducts(ab, bc, ca);
  const auto largest = static_cast<std::size_t>(std::ranges::min_element(cosines) - cosines.begin());
  std::array<double, 3> angles{};
  double left = 180.0;
  for (std::size_t i = 0; i < 3; ++i)
    if (i != largest) left -= angles[i] = toDegrees(std::atan2(twice_area, cosines[i]));
  angles[largest] = left;
  return angles;
}

double leastSpaceAngleDeg(const SpacePoint& a, const SpacePoint& b, const SpacePoint& c) {
  const SpacePoint ab = b - a, bc = c - b, ca = a - c;
  return toDegrees(std::atan2(lengthOf(cross(ab, bc)), std::ranges::max(cornerProducts(ab, bc, ca))));
}

std::array<double, 3> surfaceAnglesDeg(const Point& a, const Point& b, const Point& c, const Surface& surface) {
  if (!surface.isCurved()) return anglesDeg(a, b, c);
  // From the place where the sphere touches the plane.
  const auto onSphere = [&surface](const Point& p) {
    const double shrink = surface.shrinkAt(p);
    return SpacePoint{shrink * p.x, shrink * p.y, -shrink * squaredLength(p) / (2.0 * surface.radius())};
  };
  return spaceAnglesDeg(onSphere(a), onSphere(b), onSphere(c));
}

double signedArea(const Point& a, const Point& b, const Point& c) { return 0.5 * cross(b - a, c - a); }

void MeshQuality::add(const MeshQuality& other) {
  vertices += other.vertices;
  triangles += other.triangles;
  area += other.area;
  min_angle_deg = std::min(min_angle_deg, other.min_angle_deg);
  max_angle_deg = std::max(max_angle_deg, other.max_angle_deg);
  shortest_edge = std::min(shortest_edge, other.shortest_edge);
  longest_edge = std::max(longest_edge, other.longest_edge);
  bounds.add(other.bounds);
  for (std::size_t i = 0; i < angle_histogram.size(); ++i) angle_histogram[i] += other.angle_histogram[i];
}

namespace {

// What is measured of a triangle.
struct TriangleMeasure {
  double area;
  std::array<double, 3> angles, lengths;
};

TriangleMeasure measureTriangle(const Point& a, const Point& b, const Point& c) {
  return {signedArea(a, b, c), anglesDeg(a, b, c), {distance(a, b), distance(b, c), distance(c, a)}};
}

TriangleMeasure measureTriangle(const SpacePoint& a, const SpacePoint& b, const SpacePoint& c) {
  return {
      0.5 * lengthOf(cross(b - a, c - a)), spaceAnglesDeg(a, b, c), {distance(a, b), distance(b, c), distance(c, a)}};
}

}  // namespace

MeshQuality measureQuality(const TriMesh& mesh, double min_angle_deg, double max_angle_deg, const ItemLoop& loop,
                           std::span<const SpacePoint> places) {
  assert(places.empty() || places.size() == mesh.points.size());
  struct Part {
    MeshQuality quality;
    std::vector<TriId> below;
  };
  const auto measure = [&](std::size_t first, std::size_t last) {
    Part part;
    MeshQuality& quality = part.quality;
    quality.triangles = last - first;
    for (std::size_t t = first; t < last; ++t) {
      const auto& v = mesh.triangles[t].v;
      const TriangleMeasure measured = places.empty()
                                           ? measureTriangle(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]])
                                           : measureTriangle(places[v[0]], places[v[1]], places[v[2]]);
      quality.area += measured.area;
      double least = 180.0, most = 0.0;
      for (unsigned i = 0; i < 3; ++i) {
        least = std::min(least, measured.angles[i]);
        most = std::max(most, measured.angles[i]);
        const auto bin = static_cast<std::size_t>(measured.angles[i] / 5.0);
        ++quality.angle_histogram[std::min(bin, quality.angle_histogram.size() - 1)];
        quality.shortest_edge = std::min(quality.shortest_edge, measured.lengths[i]);
        quality.longest_edge = std::max(quality.longest_edge, measured.lengths[i]);
      }
      quality.min_angle_deg = std::min(quality.min_angle_deg, least);
      quality.max_angle_deg = std::max(quality.max_angle_deg, most);
      if (least < min_angle_deg || most > max_angle_deg) part.below.push_back(static_cast<TriId>(t));
    }
    return part;
  };
  const std::vector<Part> parts = overStretches(loop, mesh.triangles.size(), measure);
  MeshQuality whole;
  for (const Part& part : parts) whole.add(part.quality);
  if (std::ranges::any_of(parts, [](const Part& part) { return !part.below.empty(); })) {
    const TriangleBound asked(min_angle_deg, max_angle_deg, std::numeric_limits<double>::infinity());
    const InputCorners corners(mesh, asked, loop);
    for (const Part& part : parts) {
      for (const TriId t : part.below) {
        const auto& v = mesh.triangles[t].v;
        whole.bounds.add(corners.excuseOf(mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]));
      }
    }
  }
  const std::vector<std::uint8_t> used = usedVertices(mesh, loop);
  whole.vertices = static_cast<std::uint64_t>(std::ranges::count(used, std::uint8_t{1}));
  return whole;
}

}  // namespace coastmesh
