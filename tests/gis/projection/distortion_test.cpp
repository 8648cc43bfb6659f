#include "gis/projection/distortion.hpp"

#include <gtest/gtest.h>

#include "tests/support/gis_shapes.hpp"

namespace coastmesh {
namespace {

Distortion distortionOf(const std::vector<Feature>& features, const char* plane) {
  const Crs crs = parseCrs(plane);
  return largestDistortion(coastlineOf(features, wgs84()), crs, Projection::to(wgs84(), crs));
}

TEST(Distortion, ConformalPlanesHaveNone) {
  for (const char* plane : {"EPSG:32632", "EPSG:3395", "EPSG:3034", "EPSG:3031"})
    EXPECT_NEAR(distortionOf({polygonFeature(0, square(7, -70, 10))}, plane).ratio, 1.0, 1e-6) << plane;
}

// Degrees as metres: parallels are twice too long at 60 degrees.
TEST(Distortion, IsTheLargestOfTheDomain) {
  const Distortion found =
      distortionOf({polygonFeature(0, square(7, 50, 10)), polygonFeature(1, square(7, 0, 1))}, "ESRI:54001");
  EXPECT_NEAR(found.ratio, 2.0, 0.01);
  EXPECT_EQ(found.place.y, 60.0);
  // arcsine of (2 - 1) / (2 + 1), twice
  EXPECT_NEAR(found.degrees, 38.9, 0.3);
}

// Land and lakes far beyond a frame are not meshed.
TEST(Distortion, CountsWithinTheFrame) {
  Feature land = polygonFeature(0, square(-60, -60, 120)), frame = polygonFeature(1, square(7, 0, 5));
  land.use = FeatureUse::Land, frame.use = FeatureUse::Frame;
  EXPECT_LT(distortionOf({land, frame}, "ESRI:54001").ratio, 1.01);
  land.use = FeatureUse::Area;
  EXPECT_LT(distortionOf({land, polygonFeature(2, square(8, 1, 1)), frame}, "ESRI:54001").ratio, 1.01);
  EXPECT_GT(distortionOf({land}, "ESRI:54001").ratio, 1.9);
}

}  // namespace
}  // namespace coastmesh
