#include "gis/grid/local_plane.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "core/quality.hpp"
#include "gis/crs/geodesy.hpp"

namespace coastmesh {
namespace {

// A triangle of some kilometres; `turn` chooses the direction of its first side.
std::array<Point, 3> triangleAt(const Point& place, double turn) {
  constexpr double kSizeDeg = 0.05;
  const double stretch = 1.0 / std::cos(place.y * std::numbers::pi / 180.0);
  std::array<Point, 3> p;
  for (unsigned i = 0; i < 3; ++i) {
    const double angle = turn + 2.3 * i;
    p[i] = {place.x + kSizeDeg * stretch * std::cos(angle), place.y + kSizeDeg * std::sin(angle)};
  }
  return p;
}

// The angles of the plane triangle whose sides have the lengths of the geodesics.
std::array<double, 3> groundAnglesDeg(const std::array<Point, 3>& p) {
  const std::array<std::array<std::uint32_t, 3>, 1> corners{{{0, 1, 2}}};
  const auto [ab, bc, ca] = edgeLengths(p, corners, wgs84()).front();
  const auto opposite = [](double side, double one, double other) {
    return std::acos((one * one + other * other - side * side) / (2.0 * one * other)) * 180.0 / std::numbers::pi;
  };
  return {opposite(bc, ab, ca), opposite(ca, ab, bc), opposite(ab, bc, ca)};
}

std::array<double, 3> planeAnglesDeg(std::array<Point, 3> p, EarthShape shape) {
  flattenLocally(wgs84(), p, shape);
  return anglesDeg(p[0], p[1], p[2]);
}

TEST(LocalPlane, AnglesAreThoseOnTheEllipsoidOrOnTheSphere) {
  double largest = 0.0;  // difference between the two
  for (const double lat : {-89.0, -55.0, 0.0, 20.0, 45.0, 80.0}) {
    for (const double turn : {0.0, 0.7, 1.4}) {
      const auto p = triangleAt({179.99, lat}, turn);
      const auto ground = groundAnglesDeg(p), plane = planeAnglesDeg(p, EarthShape::Ellipsoid);
      const auto sphere = planeAnglesDeg(p, EarthShape::Sphere);
      const auto flat = flatAnglesDeg(onSphere(asLonLat(p[0])), onSphere(asLonLat(p[1])), onSphere(asLonLat(p[2])));
      for (unsigned i = 0; i < 3; ++i) {
        EXPECT_NEAR(plane[i], ground[i], 1e-3) << lat << ' ' << turn;
        EXPECT_NEAR(sphere[i], flat[i], 1e-3) << lat << ' ' << turn;
        largest = std::max(largest, std::abs(sphere[i] - plane[i]));
      }
    }
  }
  EXPECT_GT(largest, 0.2);
  EXPECT_LT(largest, 0.39);
}

TEST(LocalPlane, LengthsAreThoseOnTheGround) {
  for (const double lat : {0.0, 50.0, 89.0}) {
    auto p = triangleAt({10.0, lat}, 0.3);
    const std::array<std::array<std::uint32_t, 3>, 1> corners{{{0, 1, 2}}};
    const double ground = edgeLengths(p, corners, wgs84()).front()[0];
    flattenLocally(wgs84(), p);
    EXPECT_NEAR(std::hypot(p[1].x - p[0].x, p[1].y - p[0].y) / ground, 1.0, 2e-5);
  }
}

TEST(LocalPlane, PlacesOnTheSphereFollowFromThoseOnTheEllipsoid) {
  for (const LonLat& place : {LonLat{0.0, 0.0}, LonLat{-120.0, 47.0}, LonLat{33.0, -90.0}, LonLat{180.0, 12.5}}) {
    const SphereVector found = fromEllipsoid(inSpace(place, wgs84(), EarthShape::Ellipsoid), wgs84());
    for (unsigned i = 0; i < 3; ++i) EXPECT_NEAR(found[i], onSphere(place)[i], 1e-15);
  }
}

}  // namespace
}  // namespace coastmesh
