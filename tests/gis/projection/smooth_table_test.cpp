// Tables of projections against the projections themselves.
#include "gis/projection/smooth_table.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/gis_shapes.hpp"
#include "tests/support/item_loops.hpp"

namespace coastmesh {
namespace {

struct Case {
  const char* name;
  double west, east, south, north;
  bool all;  // true if all squares are tabulated
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

class SmoothTableOf : public ::testing::TestWithParam<Case> {
 protected:
  static Projection fit(const Case& c, const Crs& crs = wgs84()) {
    const Ring ring{{c.west, c.south}, {c.east, c.south}, {c.east, c.north}, {c.west, c.north}};
    return Projection::fitted(coastlineOf({polygonFeature(1, ring)}, crs), {0});
  }
};

// Degrees; some hundredths of a micrometre.
constexpr double kNear = 5e-13;

TEST_P(SmoothTableOf, PlacesAreTheProjectionsOwn) {
  const Case& c = GetParam();
  const Projection projection = fit(c);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> lon(c.west, c.east), lat(c.south, c.north);
  std::vector<Point> points;
  for (int i = 0; i < 400000; ++i) {
    const double x = lon(random), y = lat(random);
    points.push_back(projection.forward({x, y}));
  }
  const SmoothTable inverse = inverseTable(projection, points, inOrder),
                    same = inverseTable(projection, points, testing::backwards),
                    measure = measureTable(projection, points, inOrder);
  ASSERT_GT(inverse.squares(), 0u);
  EXPECT_EQ(inverse.tabulated() == inverse.squares(), c.all) << inverse.tabulated() << " of " << inverse.squares();
  double off = 0.0, off_measure = 0.0;
  for (std::size_t i = 0; i < points.size(); i += 7) {
    const Point place = inverse.at(points[i]), other = same.at(points[i]), own = projection.inverse(points[i]);
    off = std::max({off, std::abs(place.x - own.x) * std::cos(own.y * M_PI / 180.0), std::abs(place.y - own.y)});
    EXPECT_EQ(other, place);
    off_measure = std::max(off_measure, std::abs(measure.at(points[i]).x / projection.measureAt(points[i]) - 1.0));
  }
  EXPECT_LT(off, kNear);
  EXPECT_LT(off_measure, 1e-14);
}

INSTANTIATE_TEST_SUITE_P(
    Places, SmoothTableOf,
    ::testing::Values(Case{"Transverse", -2.0, 3.0, 50.0, 58.0, true}, Case{"Conic", 10.0, 25.0, 41.0, 45.0, true},
                      Case{"Equator", 100.0, 112.0, -3.0, 3.0, true}, Case{"At180", 176.0, 184.0, -45.0, -40.0, true},
                      Case{"North", 14.0, 20.0, 76.0, 80.5, false}, Case{"Pole", -180.0, 180.0, 85.0, 90.0, false}),
    [](const auto& each) { return std::string(each.param.name); });

TEST(SmoothTable, OfFewPointsIsTheProjection) {
  const Projection projection = Projection::fitted(
      coastlineOf({polygonFeature(1, {{-2.0, 50.0}, {3.0, 50.0}, {3.0, 58.0}, {-2.0, 58.0}})}, wgs84()), {0});
  const std::vector<Point> points{{0.0, 0.0}, {50000.0, 90000.0}};
  const SmoothTable table = inverseTable(projection, points, inOrder);
  EXPECT_EQ(table.squares(), 0u);
  EXPECT_EQ(table.at(points[1]), projection.inverse(points[1]));
}

// Steps, corners and values that are not finite are not polynomials.
TEST(SmoothTable, LeavesOutWhatIsNotSmooth) {
  const auto map = [](const Point& x) {
    if (x.x > 3.1) return Point{x.x < 4.0 ? std::sqrt(3.99 - x.x) : x.x, std::abs(x.y - 2.3)};
    return Point{x.x < 1.6 ? x.x * x.y : x.x * x.y + 1.0, x.y * x.y};
  };
  const SmoothTable table(map, Box{0, 0, 6, 6}, 1.0, inOrder);
  EXPECT_EQ(table.squares(), 36u);
  EXPECT_EQ(table.tabulated(), 12u + 2u * 5u);
  for (double y = -0.05; y < 6.2; y += 0.0217) {
    for (double x = -0.05; x < 6.2; x += 0.0173) {
      const Point value = table.at({x, y}), own = map({x, y});
      if (std::isnan(own.x)) {
        EXPECT_TRUE(std::isnan(value.x));
        continue;
      }
      EXPECT_NEAR(value.x, own.x, 1e-13) << x << ' ' << y;
      EXPECT_NEAR(value.y, own.y, 1e-13) << x << ' ' << y;
    }
  }
}

}  // namespace
}  // namespace coastmesh
