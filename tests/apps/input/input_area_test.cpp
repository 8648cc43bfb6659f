// The input's area is that of the water to be meshed, no matter how often its rings are given and in which orientation.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>

#include "apps/job/mesh_job.hpp"
#include "tests/support/gis_shapes.hpp"

namespace coastmesh {

namespace {

Ring turned(Ring ring) {
  std::ranges::reverse(ring);
  return ring;
}

MeshJobResult meshed(std::vector<Feature> features, const Crs& crs) {
  MeshJob job;
  job.input.ready = std::make_shared<Coastline>(coastlineOf(std::move(features), crs));
  return runMeshJob(job);
}

// The parameter is true for degrees, false for a plane.
class InputArea : public ::testing::TestWithParam<bool> {
 protected:
  static Crs crs() { return GetParam() ? wgs84() : Crs{}; }
  static double areaOf(std::vector<Feature> features) {
    return meshed(std::move(features), crs()).input_area_m2.value();
  }
  // Area of the square from (0, 40) to (4, 44).
  static double whole() { return areaOf({polygonFeature(1, square(0, 40, 4))}); }
  static void expectNear(double area, double expected) { EXPECT_NEAR(area / expected, 1.0, 1e-12); }
};

TEST_P(InputArea, IsThatOfTheMesh) {
  const MeshJobResult result = meshed({polygonFeature(1, square(0, 40, 0.1), {square(0.02, 40.02, 0.03)})}, crs());
  EXPECT_NEAR(result.input_area_m2.value() / result.mesh_area_m2, 1.0, 1e-5);
}

TEST_P(InputArea, OfARingGivenTwiceInOneFeature) {
  // By the even-odd rule the second ring would cancel the first if it were not an exact copy.
  Feature feature = polygonFeature(1, square(0, 40, 4));
  feature.polygons.push_back(feature.polygons.front());
  const MeshJobResult result = meshed({feature}, crs());
  EXPECT_NEAR(result.input_area_m2.value() / result.mesh_area_m2, 1.0, 2e-3);
}

TEST_P(InputArea, OfFeaturesThatOverlapOrAreThereTwice) {
  const double expected = whole();
  expectNear(areaOf({polygonFeature(1, square(0, 40, 4)), polygonFeature(2, square(0, 40, 4))}), expected);
  expectNear(areaOf({polygonFeature(1, square(0, 40, 4)), polygonFeature(2, turned(square(0, 40, 4)))}), expected);
  expectNear(areaOf({polygonFeature(1, square(0, 40, 4)), polygonFeature(2, square(1, 41, 1))}), expected);
}

TEST_P(InputArea, OfHolesThatAreNone) {
  const double expected = whole();
  // A hole beyond the outer ring, and one without area.
  const double beyond = areaOf({polygonFeature(1, square(9, 40, 1))});
  const MeshJobResult result = meshed({polygonFeature(1, square(0, 40, 4), {square(9, 40, 1)})}, crs());
  const double area = result.input_area_m2.value();
  EXPECT_NEAR(area / result.mesh_area_m2, 1.0, 2e-3);
  EXPECT_GT(area, expected - 0.5 * beyond);
  expectNear(areaOf({polygonFeature(1, square(0, 40, 4), {{{1, 41}, {2, 41}, {1, 41}}})}), expected);
}

TEST_P(InputArea, OfAHoleGivenTwice) {
  const double expected = areaOf({polygonFeature(1, square(0, 40, 4), {square(1, 41, 1)})});
  EXPECT_LT(expected, whole());
  const MeshJobResult result =
      meshed({polygonFeature(1, square(0, 40, 4), {square(1, 41, 1), turned(square(1, 41, 1))})}, crs());
  EXPECT_NEAR(result.input_area_m2.value() / result.mesh_area_m2, 1.0, 2e-3);
}

TEST_P(InputArea, OfABowTie) {
  const MeshJobResult result = meshed({polygonFeature(1, {{0, 40}, {4, 44}, {4, 40}, {0, 44}})}, crs());
  EXPECT_NEAR(result.input_area_m2.value() / result.mesh_area_m2, 1.0, 2e-3);
}

INSTANTIATE_TEST_SUITE_P(In, InputArea, ::testing::Bool());

}  // namespace

}  // namespace coastmesh
