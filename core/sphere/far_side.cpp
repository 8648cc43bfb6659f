#include "core/sphere/far_side.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/predicates.hpp"
#include "core/space_point.hpp"
#include "core/sphere/sphere_place.hpp"

namespace coastmesh {
namespace {

SpacePoint unit(const SpacePoint& a) { return (1.0 / lengthOf(a)) * a; }

bool holds(const TriMesh& mesh, const Point& p) {
  return std::ranges::any_of(mesh.triangles, [&](const Triangle& t) {
    const Point &a = mesh.point(t.v[0]), &b = mesh.point(t.v[1]), &c = mesh.point(t.v[2]);
    return orient2d(a, b, p) >= 0 && orient2d(b, c, p) >= 0 && orient2d(c, a, p) >= 0;
  });
}

}  // namespace

std::vector<Point> farSideVertices(const TriMesh& mesh, const Surface& surface) {
  SpacePoint sum{};
  for (const Point& p : mesh.points) sum = sum + placeOnSphere(p, surface);
  if (!(lengthOf(sum) > 0.0)) return {};
  const SpacePoint middle = unit(sum);
  for (const Point& p : mesh.points)
    if (!(dot(placeOnSphere(p, surface), middle) > 0.0)) return {};
  const SpacePoint opposite = -1.0 * middle;
  if (!holds(mesh, planeOf(opposite, surface))) return {};
  // The opposite place, and four around it, a little farther from the input than a right angle.
  constexpr double kFromOpposite = 80.0 * std::numbers::pi / 180.0;
  const SpacePoint aside = std::abs(middle.z) < 0.9 ? SpacePoint{0.0, 0.0, 1.0} : SpacePoint{1.0, 0.0, 0.0};
  const SpacePoint east = unit(cross(aside, middle)), north = cross(middle, east);
  std::vector<Point> vertices{planeOf(opposite, surface)};
  for (const SpacePoint& way : {east, north, -1.0 * east, -1.0 * north})
    vertices.push_back(planeOf(std::cos(kFromOpposite) * opposite + std::sin(kFromOpposite) * way, surface));
  return vertices;
}

}  // namespace coastmesh
