#include "gis/crs/geographic_map.hpp"

#include <gtest/gtest.h>

#include <GeographicLib/TransverseMercator.hpp>
#include <array>
#include <cmath>

#include "gis/crs/geodesy.hpp"

namespace coastmesh {
namespace {

TEST(GeographicMap, LeavesLongitudesAndLatitudesAsTheyAre) {
  const GeographicMap map(parseCrs("EPSG:4326"));
  EXPECT_TRUE(map.isIdentity());
  EXPECT_EQ(map.forward({187.25, -89.5}), (LonLat{187.25, -89.5}));
  EXPECT_EQ(map.inverse({-541, 3}), (Point{-541, 3}));
}

TEST(GeographicMap, TakesEastingsAndNorthingsToThePlaceOnTheEllipsoid) {
  const GeographicMap map(parseCrs("EPSG:32633"));  // UTM, central meridian 15 degrees
  EXPECT_FALSE(map.isIdentity());
  double x, y;
  GeographicLib::TransverseMercator::UTM().Forward(15.0, 61.5, 16.75, x, y);
  const Point utm{x + 500000, y};
  const LonLat place = map.forward(utm);
  EXPECT_NEAR(place.lon, 16.75, 1e-10);
  EXPECT_NEAR(place.lat, 61.5, 1e-10);
  EXPECT_NEAR(map.inverse(place).x, utm.x, 1e-5);
  EXPECT_NEAR(map.inverse(place).y, utm.y, 1e-5);
}

// Lambert zone II of France uses grads and the meridian of Paris; its scale is 0.99988 along 52 grads north.
TEST(GeographicMap, HasDegreesWhateverTheCrsCountsIn) {
  const Crs france = parseCrs("EPSG:27572");
  const LonLat place = GeographicMap(france).forward({600000, 2200000});
  EXPECT_NEAR(place.lat, 52 * 0.9, 1e-6);
  const std::vector<Point> square{{600000, 2200000}, {610000, 2200000}, {610000, 2210000}, {600000, 2210000}};
  const std::vector<std::array<std::uint32_t, 3>> triangles{{0, 1, 2}, {0, 2, 3}};
  const std::vector<double> areas = triangleAreas(square, triangles, france);
  EXPECT_NEAR((areas[0] + areas[1]) * 0.99988 * 0.99988, 1e8, 1e4);
  EXPECT_NEAR(edgeLengths(square, triangles, france)[0][0] * 0.99988, 1e4, 0.5);
  EXPECT_NEAR(chainLengths({{square[0], square[1]}}, france)[0] * 0.99988, 1e4, 0.5);
}

}  // namespace
}  // namespace coastmesh
