#include "gis/crs/geodesy.hpp"

#include <gtest/gtest.h>

#include <GeographicLib/Geodesic.hpp>
#include <GeographicLib/PolygonArea.hpp>
#include <cmath>
#include <numeric>
#include <span>

#include "core/bulk_list.hpp"
#include "gis/error.hpp"
#include "gis/projection/projection.hpp"
#include "tests/gis/grid_samples.hpp"
#include "tests/support/bulk_lists.hpp"

namespace coastmesh {
namespace {

using testing::lattice;

double polygonArea(std::span<const Point> nodes, const std::vector<std::uint32_t>& loop) {
  GeographicLib::PolygonArea polygon(GeographicLib::Geodesic::WGS84());
  for (std::uint32_t node : loop) polygon.AddPoint(nodes[node].y, nodes[node].x);
  double perimeter = 0.0, area = 0.0;
  polygon.Compute(false, true, perimeter, area);
  return area;
}

std::vector<std::array<std::uint32_t, 3>> cornersOf(const TriMesh& mesh) {
  std::vector<std::array<std::uint32_t, 3>> corners;
  for (const Triangle& t : mesh.triangles) corners.push_back(t.v);
  return corners;
}

struct Extent {
  Point south_west;
  double degrees;  // size of a cell
};

void PrintTo(const Extent& extent, std::ostream* out) { *out << extent.degrees << " degrees"; }

class TriangleAreas : public ::testing::TestWithParam<Extent> {};

// The triangles of a square of cells add up to the geodesic polygon round it, whatever their size and place.
TEST_P(TriangleAreas, AddUpToThePolygon) {
  const auto& [south_west, degrees] = GetParam();
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> shift(-0.25, 0.25);
  constexpr int kCells = 12;
  const TriMesh mesh = lattice(
      kCells, kCells, [](int, int) { return true; },
      [&](int i, int j) {
        return Point{south_west.x + degrees * (i + shift(random)), south_west.y + degrees * (j + shift(random))};
      });
  const BulkList<double> areas = triangleAreas(mesh.points, cornersOf(mesh), wgs84());
  const double sum = std::accumulate(areas.begin(), areas.end(), 0.0);
  const double whole = polygonArea(mesh.points, boundaryLoops(mesh).at(0));
  // PolygonArea is accurate to about 0.1 square metres.
  EXPECT_NEAR(sum, whole, 1e-7 * whole + 0.5);
}

// Cells of 11 m to 550 km; some near 20 km, where triangles change from the series to the exact formula.
INSTANTIATE_TEST_SUITE_P(Places, TriangleAreas,
                         ::testing::Values(Extent{{-87.5, 43.1}, 1e-3}, Extent{{-87.5, 43.1}, 0.01},
                                           Extent{{-87.5, 43.1}, 0.1}, Extent{{-87.5, 43.1}, 0.14},
                                           Extent{{-87.5, 43.1}, 0.17}, Extent{{10.0, -30.0}, 1.0},
                                           Extent{{-30.0, -30.0}, 5.0}, Extent{{179.5, -17.0}, 0.1},
                                           Extent{{0.0, 80.0}, 0.1}, Extent{{0.0, -89.9}, 0.008}));

TEST(TriangleAreas, OfFewAreThoseOfAll) {
  const std::vector<Point> nodes{{5.0, 60.0}, {5.12, 60.01}, {5.05, 60.14}, {5.2, 60.1}, {12.0, 61.0}};
  const std::vector<std::array<std::uint32_t, 3>> all{{0, 1, 2}, {1, 3, 2}, {3, 4, 2}}, few{{3, 4, 2}, {0, 1, 2}};
  const BulkList<double> areas = triangleAreas(nodes, all, wgs84());
  EXPECT_EQ(areasOfFew(nodes, few, wgs84()), (std::vector<double>{areas[2], areas[0]}));
}

// Single triangles of 10 to 15 km against the exact formula.
TEST(TriangleAreas, AgreeWithTheExactFormulaOneByOne) {
  for (const double latitude : {0.0, 30.0, 60.0, 85.0}) {
    const std::vector<Point> nodes{{5.0, latitude}, {5.12, latitude + 0.01}, {5.05, latitude + 0.14}};
    const double area = triangleAreas(nodes, std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}}, wgs84()).at(0);
    const double exact = polygonArea(nodes, {0, 1, 2});
    EXPECT_NEAR(area, exact, 1e-7 * exact) << latitude;
  }
}

// Edges of 20 to 60 km, computed by a series, anywhere and of any shape found in meshes: within 1e-9 of the exact
// formula, whose own error is about 0.01 square metres.
TEST(TriangleAreas, OfMediumTrianglesAreThoseOfTheExactFormula) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  const GeographicLib::Geodesic& geodesic = GeographicLib::Geodesic::WGS84();
  for (int i = 0; i < 5000; ++i) {
    const double lat = 180.0 * share(random) - 90.0, lon = 360.0 * share(random) - 180.0, turn = 360.0 * share(random);
    std::vector<Point> nodes;
    for (int k = 0; k < 3; ++k) {
      double to_lat = 0.0, to_lon = 0.0;
      geodesic.Direct(lat, lon, turn + 120.0 * k + 40.0 * share(random), 13e3 + 16e3 * share(random), to_lat, to_lon);
      nodes.push_back({to_lon, to_lat});
    }
    const double exact = polygonArea(nodes, {0, 2, 1});  // azimuths run clockwise
    EXPECT_NEAR(triangleAreas(nodes, {{{0, 2, 1}}}, wgs84())[0], exact, 1e-9 * exact + 0.2) << lon << ' ' << lat;
  }
}

TEST(TriangleAreas, AreTheSameInAProjectedCrs) {
  const TriMesh mesh = lattice(
      4, 4, [](int, int) { return true; },
      [](int i, int j) {
        return Point{-87.5 + 0.2 * i, 43.0 + 0.1 * j};
      });
  const Projection utm = Projection::to(wgs84(), parseCrs("EPSG:32616"));
  std::vector<Point> projected;
  for (const Point& p : mesh.points) projected.push_back(utm.forward(p));
  const BulkList<double> areas = triangleAreas(mesh.points, cornersOf(mesh), wgs84());
  const BulkList<double> again = triangleAreas(projected, cornersOf(mesh), parseCrs("EPSG:32616"));
  for (std::size_t t = 0; t < areas.size(); ++t) EXPECT_NEAR(again[t], areas[t], 1e-8 * areas[t]);
}

TEST(TriangleAreas, AreSignedInThePlane) {
  const std::vector<Point> nodes{{0, 0}, {2, 0}, {0, 3}};
  const std::vector<std::array<std::uint32_t, 3>> both{{0, 1, 2}, {0, 2, 1}};
  EXPECT_EQ(triangleAreas(nodes, both, Crs{}), (std::vector<double>{3.0, -3.0}));
}

TEST(TriangleAreas, RefuseNodesOffTheEarth) {
  const std::vector<Point> nodes{{5e5, 5e6}, {6e5, 5e6}, {1e30, 5.1e6}};
  EXPECT_THROW(triangleAreas(nodes, std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}}, parseCrs("EPSG:32616")),
               InputError);
}

TEST(ChainLengths, FollowGeodesics) {
  // A quadrant of the meridian of WGS 84, and a step across the antimeridian on the equator.
  const std::vector<double> lengths = chainLengths({{{7, 0}, {7, 45}, {7, 90}}, {{179.5, 0}, {-179.5, 0}}}, wgs84());
  EXPECT_NEAR(lengths.at(0), 10001965.729, 1e-3);
  EXPECT_NEAR(lengths.at(1), 6378137.0 * M_PI / 180.0, 1e-6);
  EXPECT_EQ(chainLengths({{{0, 0}, {3, 4}, {3, 5}}, {}}, Crs{}), (std::vector<double>{6.0, 0.0}));
}

}  // namespace
}  // namespace coastmesh
