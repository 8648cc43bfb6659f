#include "gis/file/cf_grid_mapping.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace coastmesh {
namespace {

using ::testing::Contains;
using ::testing::DoubleNear;
using ::testing::Key;
using ::testing::Not;
using ::testing::Pair;

// CF 1.8, Appendix F: the pole, and either the standard parallel or the scale factor.
TEST(CfGridMapping, PolarStereographicByItsStandardParallel) {
  const CfGridMapping mapping = cfGridMapping(parseCrs("EPSG:3031"));
  EXPECT_EQ(mapping.name, "polar_stereographic");
  EXPECT_THAT(mapping.parameters, Contains(Pair("straight_vertical_longitude_from_pole", 0.0)));
  EXPECT_THAT(mapping.parameters, Contains(Pair("latitude_of_projection_origin", -90.0)));
  EXPECT_THAT(mapping.parameters, Contains(Pair("standard_parallel", -71.0)));
  EXPECT_THAT(mapping.parameters, Not(Contains(Key("scale_factor_at_projection_origin"))));
}

TEST(CfGridMapping, PolarStereographicByItsScale) {
  const CfGridMapping mapping = cfGridMapping(parseCrs("EPSG:32661"));
  EXPECT_THAT(mapping.parameters, Contains(Pair("latitude_of_projection_origin", 90.0)));
  EXPECT_THAT(mapping.parameters, Contains(Pair("scale_factor_at_projection_origin", 0.994)));
  EXPECT_THAT(mapping.parameters, Contains(Pair("false_easting", 2000000.0)));
  EXPECT_THAT(mapping.parameters, Not(Contains(Key("standard_parallel"))));
}

// CF 1.8, Appendix F: in the units of the coordinates. EPSG gives 656166.667 US survey feet.
TEST(CfGridMapping, FalseOriginInTheUnitOfCoordinates) {
  const CfGridMapping mapping = cfGridMapping(parseCrs("EPSG:2236"));
  EXPECT_THAT(mapping.parameters, Contains(Pair("false_easting", DoubleNear(656166.667, 1e-6))));
}

}  // namespace
}  // namespace coastmesh
