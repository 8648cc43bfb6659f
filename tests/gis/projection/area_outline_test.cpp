#include "gis/projection/area_outline.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "gis/crs/geodesy.hpp"
#include "gis/projection/projection.hpp"

namespace coastmesh {
namespace {

Ring parallel(double lat, bool eastward) {
  Ring ring;
  for (int i = 0; i < 24; ++i) ring.push_back({-170.0 + 15.0 * i, lat});
  if (!eastward) std::ranges::reverse(ring);
  return ring;
}

// Counter-clockwise; longitudes jump if it crosses the antimeridian.
Ring box(double west, double south, double east, double north) {
  Ring ring{{west, south}, {east, south}, {east, north}, {west, north}};
  for (Point& p : ring)
    if (p.x > 180.0) p.x -= 360.0;
  return ring;
}

Ring reversed(Ring ring) {
  std::ranges::reverse(ring);
  return ring;
}

std::size_t areasOf(const Coastline& outline) { return outline.features[0].polygons.size(); }
std::size_t landsOf(const Coastline& outline) {
  return outline.features.size() < 2 ? 0 : outline.features[1].polygons.size();
}

TEST(AreaOutline, TellsLandsFromOuterRings) {
  const auto expect = [](std::vector<Ring> rings, std::size_t areas, std::size_t lands) {
    const Coastline outline = areaWithin(wgs84(), std::move(rings), {}, "a test");
    EXPECT_EQ(outline.features[0].use, FeatureUse::Area);
    EXPECT_EQ(areasOf(outline), areas);
    EXPECT_EQ(landsOf(outline), lands);
  };
  for (const double west : {10.0, 170.0}) {
    expect({box(west, 10.0, west + 20.0, 20.0)}, 1, 0);
    expect({box(west, 10.0, west + 20.0, 20.0), reversed(box(west + 4.0, 12.0, west + 9.0, 15.0))}, 1, 1);
    expect({reversed(box(west, 10.0, west + 20.0, 20.0))}, 0, 1);
  }
  // Caps, what is around them, and a band.
  expect({parallel(70.0, true)}, 1, 0);
  expect({parallel(70.0, false)}, 0, 1);
  expect({parallel(-70.0, false)}, 1, 0);
  expect({parallel(-70.0, true)}, 0, 1);
  expect({parallel(-10.0, true), parallel(10.0, false)}, 0, 2);
}

TEST(AreaOutline, LargeAreasAreProjectedFromWhatIsLeftOut) {
  const auto infinityOf = [](std::vector<Ring> rings, std::vector<Point> within) {
    const Coastline outline = areaWithin(wgs84(), std::move(rings), std::move(within), "a test");
    std::vector<std::size_t> all{0};
    if (outline.features.size() > 1) all.push_back(1);
    return Projection::fitted(outline, all, SurfaceKind::Auto).infinity();
  };
  const std::vector<Point> globe{{0.0, 0.0},  {90.0, 0.0},  {180.0, 0.0}, {-90.0, 0.0},
                                 {0.0, 89.0}, {0.0, -89.0}, {45.0, 45.0}, {-135.0, -45.0}};
  // The ocean around a land.
  const auto of_ocean = infinityOf({reversed(box(20.0, 10.0, 80.0, 60.0))}, globe);
  ASSERT_TRUE(of_ocean);
  EXPECT_GT(of_ocean->x, 20.0);
  EXPECT_LT(of_ocean->x, 80.0);
  EXPECT_GT(of_ocean->y, 10.0);
  EXPECT_LT(of_ocean->y, 60.0);
  // All but a cap, which its ring alone does not tell.
  const auto of_rest = infinityOf({parallel(70.0, false)}, {globe.begin(), globe.begin() + 4});
  ASSERT_TRUE(of_rest);
  EXPECT_GT(of_rest->y, 70.0);
}

}  // namespace
}  // namespace coastmesh
