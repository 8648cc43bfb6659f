#include "gis/crs/geographic_map.hpp"

#include <gtest/gtest.h>

#include <GeographicLib/TransverseMercator.hpp>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/bulk_list.hpp"
#include "gis/crs/crs_map.hpp"
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
  const BulkList<double> areas = triangleAreas(square, triangles, france);
  EXPECT_NEAR((areas[0] + areas[1]) * 0.99988 * 0.99988, 1e8, 1e4);
  EXPECT_NEAR(edgeLengths(square, triangles, france)[0][0] * 0.99988, 1e4, 0.5);
  EXPECT_NEAR(chainLengths({{square[0], square[1]}}, france)[0] * 0.99988, 1e4, 0.5);
}

// PROJ takes milliseconds for each, and a file of many features needs one for each of them.
TEST(GeographicMap, IsMadeOnceForACrs) {
  const Crs utm = parseCrs("EPSG:32633"), laea = parseCrs("EPSG:3035");
  const std::shared_ptr<const CrsMap> first = mapToGeographic(utm);
  const std::shared_ptr<const CrsMap> other = mapToGeographic(laea);
  EXPECT_NE(first, other);
  EXPECT_EQ(mapToGeographic(parseCrs("EPSG:32633")), first);
  EXPECT_EQ(mapToGeographic(laea), other);
}

TEST(GeographicMap, TakesManyPointsAsItTakesOne) {
  const std::shared_ptr<const CrsMap> map = mapToGeographic(parseCrs("EPSG:3035"));
  const double infinite = std::numeric_limits<double>::infinity();
  const std::vector<Point> points{{4321000, 3210000}, {infinite, 0}, {2000000.5, 1500000.25}};
  std::vector<double> x, y;
  for (const Point& p : points) x.push_back(p.x), y.push_back(p.y);
  map->forward(x, y);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point one = map->forward(points[i]);
    EXPECT_EQ(std::isfinite(x[i]), i != 1);
    EXPECT_EQ(std::isfinite(one.x), i != 1);
    if (i == 1) continue;
    EXPECT_EQ((Point{x[i], y[i]}), one);
  }
}

}  // namespace
}  // namespace coastmesh
