#include "apps/job/judge_mesh.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace coastmesh {
namespace {

using Angles = std::vector<std::array<double, 3>>;

MeshQuality threeTriangles() {
  MeshQuality quality;
  quality.min_angle_deg = 33.0;
  quality.max_angle_deg = 104.0;
  for (const int k : {6, 8, 20, 10, 11, 13, 12, 12, 12}) ++quality.angle_histogram[static_cast<std::size_t>(k)];
  return quality;
}

TEST(ReplaceAngles, NewExtremesAndClassesCount) {
  MeshQuality quality = threeTriangles();
  EXPECT_TRUE(replaceAngles(Angles{{52.0, 59.0, 69.0}}, Angles{{31.0, 42.0, 107.0}}, 0.01, quality));
  EXPECT_EQ(quality.min_angle_deg, 31.0);
  EXPECT_EQ(quality.max_angle_deg, 107.0);
  EXPECT_EQ(quality.angle_histogram[6], 2u);
  EXPECT_EQ(quality.angle_histogram[10], 0u);
  EXPECT_EQ(quality.angle_histogram[21], 1u);
}

TEST(ReplaceAngles, WhoseExtremesMayBeGoneIsMeasuredAgain) {
  for (const Angles& before : {Angles{{33.005, 60.0, 86.995}}, Angles{{35.0, 41.005, 103.995}}}) {
    MeshQuality quality = threeTriangles();
    EXPECT_FALSE(replaceAngles(before, Angles{{60.0, 60.0, 60.0}}, 0.01, quality));
    EXPECT_EQ(quality.min_angle_deg, 33.0);
    EXPECT_EQ(quality.angle_histogram, threeTriangles().angle_histogram);
  }
}

}  // namespace
}  // namespace coastmesh
