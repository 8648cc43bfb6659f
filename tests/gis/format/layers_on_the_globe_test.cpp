// GIS layers return a mesh unchanged, wherever on the globe it lies.
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <numbers>
#include <set>
#include <span>

#include "gis/crs/ogr_support.hpp"
#include "gis/format/grid_layers.hpp"
#include "gis/grid/ground_orientation.hpp"
#include "gis/grid/loop_role.hpp"
#include "gis/grid/map_parts.hpp"
#include "gis/grid/wind_triangles.hpp"
#include "tests/gis/grid_samples.hpp"
#include "tests/support/bulk_lists.hpp"

namespace coastmesh {
namespace {

using testing::lattice;
using testing::TemporaryFolder;

using Vector = std::array<double, 3>;

constexpr double kDegree = std::numbers::pi / 180.0;

Vector vectorOf(const Point& lonlat) {
  const double lon = lonlat.x * kDegree, lat = lonlat.y * kDegree;
  return {std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
}

// Of the corners' vectors; in long double, because products of nearby vectors differ little.
double determinant(const Vector& a, const Vector& b, const Vector& c) {
  const auto product = [](long double x, long double y, long double z) { return x * y * z; };
  return static_cast<double>(product(a[0], b[1], c[2]) + product(a[1], b[2], c[0]) + product(a[2], b[0], c[1]) -
                             product(a[2], b[1], c[0]) - product(a[1], b[0], c[2]) - product(a[0], b[2], c[1]));
}

// The point of the sphere that a point of the tangent plane at `centre` shows, projected from the sphere's centre
// (gnomonic); longitudes from `west` on. Straight lines of the plane are great circles.
Point onGlobe(const Point& centre, const Point& plane, double west) {
  const double lon = centre.x * kDegree, lat = centre.y * kDegree;
  const Vector up = vectorOf(centre), east{-std::sin(lon), std::cos(lon), 0.0},
               north{-std::sin(lat) * std::cos(lon), -std::sin(lat) * std::sin(lon), std::cos(lat)};
  Vector v;
  for (std::size_t k = 0; k < 3; ++k) v[k] = up[k] + plane.x * east[k] + plane.y * north[k];
  double longitude = std::atan2(v[1], v[0]) / kDegree;
  while (longitude < west) longitude += 360.0;
  while (longitude > west + 360.0) longitude -= 360.0;
  return {longitude, std::atan2(v[2], std::hypot(v[0], v[1])) / kDegree};
}

Grid gridOf(const TriMesh& plane, std::vector<Point> nodes) {
  Grid grid;
  grid.crs = wgs84();
  grid.nodes.assign(nodes.begin(), nodes.end());
  for (const Triangle& t : plane.triangles) grid.triangles.push_back(t.v);
  grid.boundaries = findBoundaries(plane);
  grid.area_m2 = triangleAreas(grid.nodes, grid.triangles, grid.crs);
  return grid;
}

// A lattice with an island, anywhere, with triangles from tiny to more than 60 degrees wide.
Grid randomGrid(std::mt19937_64& random) {
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const double centre_lons[] = {-180.0, 180.0, 0.0, uniform(-180.0, 180.0)};
  const double centre_lats[] = {90.0, -90.0, uniform(-90.0, 90.0), uniform(80.0, 90.0), uniform(-60.0, 60.0)};
  const Point centre{centre_lons[random() % 4], centre_lats[random() % 5]};
  const double wests[] = {-180.0, 0.0, -360.0, centre.x - 180.0};
  const double west = wests[random() % 4];
  const double cell = std::pow(10.0, uniform(-6.0, -0.3)) * (random() % 2 == 0 ? 1.0 : 0.5);
  const int cells = 3 + static_cast<int>(random() % 3);
  const Point shift = random() % 2 == 0 ? Point{0.0, 0.0} : Point{uniform(-0.5, 0.5), uniform(-0.5, 0.5)};
  const TriMesh plane = lattice(
      cells, cells, [](int i, int j) { return i != 1 || j != 1; },
      [&](int i, int j) {
        return Point{cell * (i - cells / 2 + shift.x + uniform(-0.2, 0.2) * (shift.x != 0.0)),
                     cell * (j - cells / 2 + shift.y + uniform(-0.2, 0.2) * (shift.y != 0.0))};
      });
  std::vector<Point> nodes;
  for (const Point& p : plane.points) nodes.push_back(onGlobe(centre, p, west));
  return gridOf(plane, std::move(nodes));
}

// The plane that the mesh was made in determines which loop is the outer one.
TEST(LoopRole, OnTheGlobeAsInThePlaneThatTouchesIt) {
  std::mt19937_64 random(20261122);
  std::size_t by_area = 0;
  for (int k = 0; k < 2000; ++k) {
    const Grid grid = randomGrid(random);
    ASSERT_EQ(grid.boundaries.size(), 2u);
    for (const Boundary& boundary : grid.boundaries) {
      EXPECT_EQ(roleOfLoop(grid.nodes, boundary.nodes, grid.crs), boundary.role) << "grid " << k;
      by_area += roleByArea(grid.nodes, boundary.nodes, grid.crs).has_value();
    }
  }
  EXPECT_GT(by_area, 200u);
  EXPECT_LT(by_area, 3000u);
}

// Parallels with the mesh to the left: northwards, if the loop runs eastwards. The side with less than half of the
// globe is inside.
TEST(LoopRole, HalfTheGlobeIsTheMost) {
  for (const double west : {-180.0, 0.0, 170.0}) {
    for (const double latitude : {-89.9, -60.0, -0.1, 0.1, 60.0, 89.9}) {
      std::vector<Point> nodes;
      std::vector<std::uint32_t> loop;
      for (int i = 0; i < 72; ++i) {
        const double longitude = west + 5.0 * i;
        nodes.push_back({longitude > 180.0 ? longitude - 360.0 : longitude, latitude});
        loop.push_back(static_cast<std::uint32_t>(i));
      }
      EXPECT_EQ(roleOfLoop(nodes, loop, wgs84()), latitude > 0 ? BoundaryRole::Land : BoundaryRole::Island) << latitude;
      std::ranges::reverse(loop);
      EXPECT_EQ(roleOfLoop(nodes, loop, wgs84()), latitude > 0 ? BoundaryRole::Island : BoundaryRole::Land) << latitude;
    }
  }
}

TEST(LoopRole, APoleMayBeANode) {
  // A third of the cap around the north pole, whose longitude is arbitrary; `back` is the same loop reversed.
  for (const double pole_longitude : {0.0, 77.0, -180.0}) {
    const std::vector<Point> nodes{{0, 70}, {60, 70}, {120, 70}, {pole_longitude, 90}};
    const std::vector<std::uint32_t> around{0, 1, 2, 3}, back{3, 2, 1, 0};
    EXPECT_EQ(roleOfLoop(nodes, around, wgs84()), BoundaryRole::Land);
    EXPECT_EQ(roleOfLoop(nodes, back, wgs84()), BoundaryRole::Island);
  }
}

// In a plane, longitudes do not wrap.
TEST(LoopRole, APlaneHasNoEnds) {
  const std::vector<Point> nodes{{-179, 0}, {179, 0}, {179, 10}, {-179, 10}};
  const std::vector<std::uint32_t> loop{0, 1, 2, 3};
  EXPECT_EQ(roleOfLoop(nodes, loop, Crs{}), BoundaryRole::Land);
  EXPECT_EQ(roleOfLoop(nodes, loop, wgs84()), BoundaryRole::Island);  // the mesh is all but two degrees
}

class LayersOnTheGlobe : public ::testing::TestWithParam<const char*> {
 protected:
  std::string write(const Grid& grid) const {
    const std::string path = folder_ / (std::string("m") + GetParam());
    StagedOutput output(path, gridFormatFor(path, ""), true);
    output.write(grid);
    output.commit();
    return path;
  }

  TemporaryFolder folder_;
};

void expectSame(const Grid& got, const Grid& want) {
  const auto bits = [](std::span<const Point> points) {
    std::vector<std::array<std::uint64_t, 2>> all;
    for (const Point& p : points) all.push_back({std::bit_cast<std::uint64_t>(p.x), std::bit_cast<std::uint64_t>(p.y)});
    return all;
  };
  EXPECT_EQ(bits(got.nodes), bits(want.nodes));
  EXPECT_EQ(got.triangles, want.triangles);
  ASSERT_EQ(got.boundaries.size(), want.boundaries.size());
  for (std::size_t b = 0; b < got.boundaries.size(); ++b) {
    EXPECT_EQ(got.boundaries[b].role, want.boundaries[b].role);
    EXPECT_EQ(got.boundaries[b].closed, want.boundaries[b].closed);
    EXPECT_EQ(got.boundaries[b].nodes, want.boundaries[b].nodes);
  }
  ASSERT_EQ(got.area_m2.size(), want.area_m2.size());
  for (std::size_t t = 0; t < got.area_m2.size(); ++t)
    EXPECT_NEAR(got.area_m2[t], want.area_m2[t], 1e-14 * std::abs(want.area_m2[t]) + 1e-14);
}

TEST_P(LayersOnTheGlobe, GiveBackWhatWasWritten) {
  std::mt19937_64 random(20240301);
  for (int round = 0; round < 25; ++round) {
    SCOPED_TRACE(round);
    const Grid grid = randomGrid(random);
    expectSame(readGrid(write(grid)), grid);
  }
}

// The two shores of a wall without width, each with its own nodes; the same meridian as 180 and as -180.
TEST_P(LayersOnTheGlobe, KeepNodesThatShareAPlace) {
  Grid grid;
  grid.crs = wgs84();
  grid.nodes = {{179.0, 10.0},  {180.0, 10.0},  {180.0, 11.0}, {179.0, 11.0},  {180.0, 10.0},
                {-179.0, 10.0}, {-179.0, 11.0}, {180.0, 11.0}, {-180.0, 11.0}, {-179.5, 12.0}};
  grid.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}, {8, 6, 9}};
  grid.boundaries = {{BoundaryRole::Land, true, {0, 1, 2, 3}},
                     {BoundaryRole::Land, true, {6, 9, 8}},
                     {BoundaryRole::Open, false, {7, 4, 5}},
                     {BoundaryRole::Land, false, {5, 6, 7}}};
  grid.area_m2 = triangleAreas(grid.nodes, grid.triangles, grid.crs);
  expectSame(readGrid(write(grid)), grid);
}

// Inverted and degenerate triangles are returned unchanged, not repaired.
TEST_P(LayersOnTheGlobe, KeepWhatIsBroken) {
  Grid grid;
  grid.crs = wgs84();
  grid.nodes = {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {0.5, 0.0}, {1.0, 1.0}};
  grid.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 4, 2}};
  grid.area_m2 = triangleAreas(grid.nodes, grid.triangles, grid.crs);
  expectSame(readGrid(write(grid)), grid);
}

// The largest step in longitude along the lines of a layer, degrees.
double farthestStep(const std::string& path, const char* name) {
  registerDrivers();
  const std::unique_ptr<GDALDataset, void (*)(GDALDataset*)> dataset(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR),
                                                                     [](GDALDataset* opened) { GDALClose(opened); });
  OGRLayer* layer = dataset ? dataset->GetLayerByName(name) : nullptr;
  if (layer == nullptr && dataset && dataset->GetLayerCount() == 1) layer = dataset->GetLayer(0);
  if (layer == nullptr) return NAN;
  double farthest = 0.0;
  const auto look = [&](const OGRLineString& line) {
    for (int i = 1; i < line.getNumPoints(); ++i)
      farthest = std::max(farthest, std::abs(line.getX(i) - line.getX(i - 1)));
  };
  for (const auto& feature : layer) {
    const OGRGeometry& geometry = *feature->GetGeometryRef();
    if (wkbFlatten(geometry.getGeometryType()) == wkbMultiLineString)
      for (const OGRLineString* const part : *geometry.toMultiLineString()) look(*part);
    else
      look(*geometry.toLineString());
  }
  return farthest;
}

// Edges between two triangles.
std::vector<NodePair> innerEdges(const Grid& grid) {
  std::set<NodePair> sides;
  std::vector<NodePair> inner;
  for (const auto& t : grid.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const NodePair side{t[i], t[(i + 1) % 3]};
      sides.insert(side);
      if (sides.contains({side[1], side[0]})) inner.push_back(side);
    }
  return inner;
}

// Boundaries and lines that a map would draw across its whole width are cut at its ends, as triangles are.
TEST_P(LayersOnTheGlobe, CutLinesWhereTheMapEnds) {
  std::mt19937_64 random(20261125);
  int cut = 0;
  for (int round = 0; round < 25; ++round) {
    SCOPED_TRACE(round);
    Grid grid = randomGrid(random);
    const MapCutter cutter(grid);
    for (const NodePair& edge : innerEdges(grid))
      if (cutter.cutsLine(edge) || grid.lines.empty())
        grid.lines.push_back({LineKind::Weir, "", false, {edge[0], edge[1]}});
    const std::string path = write(grid);
    for (const char* const layer : {"boundaries", "lines"}) {
      const std::string own = pathOfLayer(path, layer);
      EXPECT_LT(farthestStep(std::filesystem::exists(own) ? own : path, layer), 180.0) << layer;
    }
    const Grid got = readGrid(path);
    expectSame(got, grid);
    ASSERT_EQ(got.lines.size(), grid.lines.size());
    for (std::size_t k = 0; k < got.lines.size(); ++k) EXPECT_EQ(got.lines[k].nodes, grid.lines[k].nodes);
    cut += std::ranges::any_of(grid.boundaries, [&](const Boundary& b) { return cutter.cutsLine(b.nodes); });
  }
  EXPECT_GT(cut, 5);
}

INSTANTIATE_TEST_SUITE_P(Formats, LayersOnTheGlobe, ::testing::Values(".gpkg", ".shp", ".geojson", ".fgb"),
                         [](const auto& instance) { return std::string(instance.param).substr(1); });

// True if a map of longitudes and latitudes has to cut some of the triangles.
bool reachesOverTheMapsEnd(const Grid& grid) {
  for (const auto& t : grid.triangles)
    for (std::size_t i = 0; i < 3; ++i) {
      const Point &p = grid.nodes[t[i]], &q = grid.nodes[t[(i + 1) % 3]];
      if (std::abs(p.x - q.x) >= 180.0 || std::abs(p.y) == 90.0) return true;
    }
  return false;
}

// Triangles without nodes, as other programs write them, are read back with the same corners and winding. Triangles
// that were cut need their nodes.
TEST(TrianglesAlone, ComeBackAlike) {
  const auto places = [](const Grid& grid) {
    std::vector<std::array<Point, 3>> all;
    for (const auto& t : grid.triangles) all.push_back({grid.nodes[t[0]], grid.nodes[t[1]], grid.nodes[t[2]]});
    return all;
  };
  for (const std::string ending : {".shp", ".geojson", ".fgb"}) {
    std::mt19937_64 random(20240302);
    int whole = 0;
    for (int round = 0; whole < 20; ++round) {
      SCOPED_TRACE(ending + ' ' + std::to_string(round));
      const TemporaryFolder folder;
      const Grid grid = randomGrid(random);
      if (reachesOverTheMapsEnd(grid)) continue;
      ++whole;
      StagedOutput output(folder / ("m" + ending), gridFormatFor("m" + ending, ""), false);
      output.write(grid);
      output.commit();
      for (const std::string& name : folder.names())
        if (name.starts_with("m_")) std::filesystem::remove(folder / name);
      EXPECT_EQ(places(readGrid(folder / ("m" + ending))), places(grid));
    }
  }
}

// A corner was moved in the triangle layer only, not in the node layer: its node number no longer applies.
TEST(EditedLayers, FollowTheGeometry) {
  const TemporaryFolder folder;
  const auto put = [&](const std::string& name, const std::string& text) {
    std::ofstream(folder / name) << R"({"type":"FeatureCollection","features":[)" << text << "]}";
  };
  put("m_nodes.geojson", R"({"type":"Feature","properties":{"id":1},"geometry":{"type":"Point","coordinates":[0,0]}},)"
                         R"({"type":"Feature","properties":{"id":2},"geometry":{"type":"Point","coordinates":[1,0]}},)"
                         R"({"type":"Feature","properties":{"id":3},"geometry":{"type":"Point","coordinates":[0,1]}})");
  put("m.geojson", R"({"type":"Feature","properties":{"id":1,"node1":1,"node2":2,"node3":3},"geometry":)"
                   R"({"type":"Polygon","coordinates":[[[0,0],[0,2],[1,0],[0,0]]]}})");
  const Grid grid = readGrid(folder / "m.geojson");
  EXPECT_EQ(grid.nodes, (std::vector<Point>{{0, 0}, {1, 0}, {0, 1}, {0, 2}}));
  EXPECT_EQ(grid.triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 1, 3}}));
}

TEST(WindTriangles, FindTheWindingAnywhere) {
  std::mt19937_64 random(20240303);
  for (int round = 0; round < 200; ++round) {
    const Grid grid = randomGrid(random);
    auto triangles = grid.triangles;
    for (auto& t : triangles)
      if (random() % 2 == 0) std::swap(t[1], t[2]);
    windTriangles(grid.nodes, grid.crs, std::vector<bool>(triangles.size(), false), triangles);
    EXPECT_EQ(triangles, grid.triangles) << round;
  }
}

// A triangle known to be wound clockwise on purpose determines the winding of its neighbours.
TEST(WindTriangles, FollowWhatIsKnown) {
  const std::vector<Point> nodes{{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  std::vector<std::array<std::uint32_t, 3>> triangles{{0, 2, 1}, {0, 2, 3}};
  windTriangles(nodes, wgs84(), {true, false}, triangles);
  EXPECT_EQ(triangles, (std::vector<std::array<std::uint32_t, 3>>{{0, 2, 1}, {0, 3, 2}}));
}

// Against the determinant of the corners' vectors, for triangles of up to a hemisphere.
TEST(OrientationOnGround, IsThatOfTheVectors) {
  std::mt19937_64 random(20240304);
  std::uniform_real_distribution<double> lon(-360.0, 360.0), lat(-90.0, 90.0);
  const Crs crs = wgs84();
  int turned = 0;
  for (int round = 0; round < 20000; ++round) {
    std::array<Point, 3> p;
    for (Point& corner : p) corner = {lon(random), random() % 50 == 0 ? 90.0 : lat(random)};
    const double exact = determinant(vectorOf(p[0]), vectorOf(p[1]), vectorOf(p[2]));
    if (std::abs(exact) < 1e-12) continue;
    EXPECT_EQ(orientationOnGround(p[0], p[1], p[2], crs), exact > 0 ? 1 : -1);
    turned += exact < 0;
  }
  EXPECT_GT(turned, 5000);
}

// Triangles of nanometres are oriented correctly as long as their coordinates resolve them.
TEST(OrientationOnGround, KeepsItsDigits) {
  const Crs crs = wgs84();
  const double ulp = std::ldexp(1.0, -46);  // of longitudes beyond 64
  for (const double lon : {-180.0, 100.0, 180.0 - 2 * ulp}) {
    for (const double lat : {0.0, 65.0, -89.0}) {
      const Point a{lon, lat}, b{lon + 4 * ulp, lat}, c{lon + 2 * ulp, lat + 4 * ulp};
      EXPECT_EQ(orientationOnGround(a, b, c, crs), 1) << lon << ' ' << lat;
      EXPECT_EQ(orientationOnGround(a, c, b, crs), -1) << lon << ' ' << lat;
      EXPECT_EQ(orientationOnGround(a, b, {lon + 2 * ulp, lat - 4 * ulp}, crs), -1) << lon << ' ' << lat;
    }
  }
  EXPECT_EQ(orientationOnGround({5, 1}, {5, 2}, {5, 3}, crs), 0);
}

}  // namespace
}  // namespace coastmesh
