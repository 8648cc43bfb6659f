#include "apps/report/file_info.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "tests/gis/quad_samples.hpp"

namespace coastmesh {

namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

MeshInfo infoWith(std::vector<double> z) {
  Grid grid;
  grid.nodes = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  grid.triangles = {{0, 1, 2}, {0, 2, 3}};
  grid.z = std::move(z);
  return describeMesh(grid);
}

TEST(MeshInfo, DepthsAreThoseThatAreKnown) {
  const MeshInfo some = infoWith({kUnknown, -3.0, -7.0, kUnknown});
  EXPECT_THAT(toText(some), HasSubstr("z               -7 to -3 m, unknown at 2 nodes\n"));
  EXPECT_EQ(Json::parse(toJson(some))["z"], (Json{-7.0, -3.0}));
  EXPECT_EQ(Json::parse(toJson(some))["nodes_without_z"], 2);
  const MeshInfo all = infoWith({-4.0, -3.0, -7.0, 2.0});
  EXPECT_THAT(toText(all), HasSubstr("z               -7 to 2 m\n"));
  EXPECT_EQ(Json::parse(toJson(all))["nodes_without_z"], 0);
  for (const MeshInfo& none : {infoWith({kUnknown, kUnknown, kUnknown, kUnknown}), infoWith({})}) {
    EXPECT_THAT(toText(none), Not(HasSubstr("\nz  ")));
    EXPECT_FALSE(Json::parse(toJson(none)).contains("z"));
  }
}

// Rectangles of 2 by 1; only triangles have a diagonal, and angles of less than 90 degrees.
TEST(MeshInfo, QuadrilateralsAreMeasuredThemselves) {
  const MeshInfo all = describeMesh(testing::mixedGrid(4, 3, [](int, int) { return true; }));
  EXPECT_EQ(all.triangles, 0u);
  EXPECT_EQ(all.quads.count, 12u);
  EXPECT_DOUBLE_EQ(all.longest_edge_m, 2.0);
  EXPECT_NEAR(all.quads.min_angle_deg, 90.0, 1e-9);
  EXPECT_DOUBLE_EQ(all.area_m2, 24.0);
  const MeshInfo some = describeMesh(testing::mixedGrid(4, 3, [](int i, int) { return i > 0; }));
  EXPECT_EQ(some.triangles, 6u);
  EXPECT_EQ(some.quads.count, 9u);
  EXPECT_DOUBLE_EQ(some.longest_edge_m, std::sqrt(5.0));
  EXPECT_NEAR(some.quality.min_angle_deg, 26.565, 0.001);
  EXPECT_EQ(some.quality.triangles, 6u);
  EXPECT_THAT(toText(some), HasSubstr(" 6 triangles, 9 quadrilaterals\n"));
}

}  // namespace

}  // namespace coastmesh
