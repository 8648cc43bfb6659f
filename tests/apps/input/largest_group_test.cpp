// The largest group is that with the most area in the frame, whatever lies beyond it.
#include "apps/input/largest_group.hpp"

#include <gtest/gtest.h>

#include <memory>

#include "apps/input/job_input.hpp"
#include "tests/support/gis_shapes.hpp"

namespace coastmesh {
namespace {

JobInput inputOf(std::vector<Feature> features, const Box& frame) {
  InputOptions options;
  options.ready = std::make_shared<Coastline>(coastlineOf(std::move(features), wgs84()));
  options.frame.box = frame;
  options.frame.side = DomainSide::Inside;
  return JobInput(options);
}

TEST(LargestGroup, IsMeasuredInTheFrame) {
  // The first is cut by the frame to a strip.
  const JobInput input =
      inputOf({polygonFeature(1, square(0, 40, 4)), polygonFeature(2, square(4.5, 40, 2))}, {3.5, 38.0, 8.0, 46.0});
  const std::optional<LargestGroup> largest = largestGroup(input);
  ASSERT_TRUE(largest.has_value());
  EXPECT_EQ(input.coastline().features[input.members(largest->group).front()].fid, 2);
  EXPECT_FALSE(largest->domain.pslg.points.empty());
}

TEST(LargestGroup, HasAShareOfAll) {
  const JobInput one = inputOf({polygonFeature(1, square(1, 40, 2))}, {0.0, 38.0, 8.0, 46.0});
  EXPECT_EQ(largestGroup(one)->share, 1.0);
  const JobInput three = inputOf(
      {polygonFeature(1, square(1, 40, 1)), polygonFeature(2, square(3, 40, 2)), polygonFeature(3, square(6, 40, 1))},
      {0.0, 38.0, 8.0, 46.0});
  const std::optional<LargestGroup> largest = largestGroup(three);
  EXPECT_EQ(largest->group, 1u);
  EXPECT_NEAR(largest->share, 4.0 / 6.0, 0.02);
}

}  // namespace
}  // namespace coastmesh
