#include "gis/crs/handedness.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace coastmesh {
namespace {

TEST(Handedness, AxesToTheSouthAndWestMirrorTheGround) {
  const Point brno{1160000.0, 600000.0};
  for (const char* const code : {"EPSG:5513", "EPSG:2065", "EPSG:8352"}) {
    EXPECT_TRUE(mirrorsGround(parseCrs(code), brno)) << code;
    EXPECT_NE(unmirrored(parseCrs(code)).find("EPSG:"), std::string::npos) << code;
  }
  EXPECT_FALSE(mirrorsGround(parseCrs("EPSG:5514"), {-brno.y, -brno.x}));
  EXPECT_EQ(unmirrored(parseCrs("EPSG:5513")), "EPSG:5514, which has axes east and north");
  const Crs unnamed = parseCrs("+proj=utm +zone=33 +axis=wnu +type=crs");
  EXPECT_TRUE(mirrorsGround(unnamed, {-500000.0, 5000000.0}));
  EXPECT_EQ(unmirrored(unnamed), "a CRS with axes east and north");
}

// A half turn does not mirror, nor do axes defined in an order other than that of files.
TEST(Handedness, OthersDoNot) {
  EXPECT_FALSE(mirrorsGround(parseCrs("EPSG:2053"), {20000.0, 3700000.0}));     // west and south
  EXPECT_FALSE(mirrorsGround(parseCrs("EPSG:2193"), {1700000.0, 5500000.0}));   // north and east
  EXPECT_FALSE(mirrorsGround(parseCrs("EPSG:31467"), {3500000.0, 5700000.0}));  // north and east
  for (const double x : {-2e6, 1.0, 2e6})
    for (const double y : {-2e6, 1.0, 2e6}) {
      EXPECT_FALSE(mirrorsGround(parseCrs("EPSG:3031"), {x, y}));
      EXPECT_FALSE(mirrorsGround(parseCrs("EPSG:3995"), {x, y}));
      EXPECT_FALSE(mirrorsGround(parseCrs("EPSG:32661"), {2e6 + x, 2e6 + y}));
    }
  EXPECT_FALSE(mirrorsGround(parseCrs("EPSG:4326"), {0.0, 0.0}));
  EXPECT_FALSE(mirrorsGround(Crs{}, {0.0, 0.0}));
  EXPECT_FALSE(mirrorsGround(parseCrs("EPSG:5513"), {std::numeric_limits<double>::quiet_NaN(), 0.0}));
}

}  // namespace
}  // namespace coastmesh
