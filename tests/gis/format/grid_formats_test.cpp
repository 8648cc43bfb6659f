// Every format that keeps coordinates returns the grid that was written; tests/gis/globe has the others.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <tuple>

#include "core/bulk_list.hpp"
#include "gis/crs/crs_map.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"
#include "gis/format/grid_io.hpp"
#include "tests/gis/grid_samples.hpp"
#include "tests/support/item_loops.hpp"

namespace coastmesh {
namespace {

using testing::sampleGrid;
using testing::TemporaryFolder;

struct Carried {
  bool title = false, sources = false, fids = true, angles = false, features = true;
};

Carried carriedBy(const std::string& format) {
  if (format == "gpkg" || format == "geojson" || format == "shp" || format == "fgb") return {false, true, true, true};
  if (format == "ugrid") return {true, true, true, true};
  if (format == "2dm") return {false, false, true, false};
  if (format == "vtu") return {false, false, true, true};
  if (format == "adcirc" || format == "schism" || format == "telemac") return {true, false, false, false, false};
  if (format == "fvcom" || format == "ww3" || format == "mike") return {false, false, false, false, false};
  return {};
}

// Formats that store open boundaries only: the rest of the boundary is shore.
bool impliesShores(const std::string& format) {
  return format == "telemac" || format == "fvcom" || format == "ww3" || format == "mike";
}

// Model formats, which begin and end boundaries according to their own rules.
bool cutsBoundaries(const std::string& format) {
  return format == "adcirc" || format == "schism" || impliesShores(format);
}

// The directed edges of boundaries, and whether each is open.
std::map<std::pair<std::uint32_t, std::uint32_t>, bool> openEdges(const Grid& grid) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, bool> edges;
  for (const Boundary& boundary : grid.boundaries) {
    const std::size_t n = boundary.nodes.size();
    for (std::size_t i = 0; i + (boundary.closed ? 0 : 1) < n; ++i)
      edges[{boundary.nodes[i], boundary.nodes[(i + 1) % n]}] = boundary.role == BoundaryRole::Open;
  }
  return edges;
}

std::vector<std::uint64_t> bitsOf(std::span<const double> values) {
  std::vector<std::uint64_t> bits;
  for (double value : values) bits.push_back(std::bit_cast<std::uint64_t>(value));
  return bits;
}

std::vector<std::uint64_t> bitsOf(std::span<const Point> points) {
  std::vector<std::uint64_t> bits;
  for (const Point& p : points) {
    bits.push_back(std::bit_cast<std::uint64_t>(p.x));
    bits.push_back(std::bit_cast<std::uint64_t>(p.y));
  }
  return bits;
}

const decltype(GridFeature::attributes) kNoAttributes;

void expectSame(const Grid& got, const Grid& want, const std::string& format) {
  const Carried carried = carriedBy(format);
  EXPECT_EQ(bitsOf(got.nodes), bitsOf(want.nodes));
  EXPECT_EQ(bitsOf(got.z), bitsOf(want.z));
  EXPECT_EQ(got.triangles, want.triangles);
  EXPECT_EQ(got.feature_of, carried.features ? want.feature_of : BulkList<std::uint32_t>());
  EXPECT_TRUE(sameCrs(got.crs, want.crs)) << nameOf(got.crs);
  EXPECT_EQ(got.crs.authority, want.crs.authority);
  EXPECT_EQ(openEdges(got), openEdges(want));
  if (!cutsBoundaries(format)) {
    ASSERT_EQ(got.boundaries.size(), want.boundaries.size());
    for (std::size_t b = 0; b < got.boundaries.size(); ++b) {
      EXPECT_EQ(got.boundaries[b].role, want.boundaries[b].role) << b;
      EXPECT_EQ(got.boundaries[b].closed, want.boundaries[b].closed) << b;
      EXPECT_EQ(got.boundaries[b].nodes, want.boundaries[b].nodes) << b;
    }
  }
  EXPECT_TRUE(got.notes.empty());
  ASSERT_EQ(got.features.size(), carried.features ? want.features.size() : 0);
  for (std::size_t f = 0; f < got.features.size(); ++f) {
    EXPECT_EQ(got.features[f].fid, carried.fids ? want.features[f].fid : static_cast<std::int64_t>(f) + 1);
    EXPECT_EQ(got.features[f].source, carried.sources ? want.features[f].source : "");
    EXPECT_EQ(got.features[f].attributes, carried.sources ? want.features[f].attributes : kNoAttributes);
  }
  EXPECT_EQ(got.title, carried.title ? want.title : "");
  if (!carried.angles) {
    EXPECT_TRUE(got.min_angle_deg.empty());
  } else if (format != "shp") {
    EXPECT_EQ(bitsOf(got.min_angle_deg), bitsOf(want.min_angle_deg));
    EXPECT_EQ(bitsOf(got.area_m2), bitsOf(want.area_m2));
  } else {
    // A .dbf keeps 15 decimals.
    ASSERT_EQ(got.min_angle_deg.size(), want.min_angle_deg.size());
    ASSERT_EQ(got.area_m2.size(), want.area_m2.size());
    for (std::size_t t = 0; t < want.triangles.size(); ++t) {
      EXPECT_NEAR(got.min_angle_deg[t], want.min_angle_deg[t], 1e-14);
      EXPECT_NEAR(got.area_m2[t], want.area_m2[t], 1e-14 * want.area_m2[t] + 1e-14);
    }
  }
}

std::string endingOf(const GridFormat& format) { return std::string(format.endings.front()); }

std::string bytesOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return std::string(std::istreambuf_iterator<char>(file), {});
}

struct Place {
  const char* name;
  const char* crs;
  Point origin;
  double size;
};

const Place kPlaces[] = {
    {"geographic", "EPSG:4326", {-87.5, 43.1}, 0.01},
    {"antimeridian", "EPSG:4326", {179.95, -16.6}, 0.01},
    {"utm", "EPSG:32616", {448123.4, 4.8e6}, 250.0},
    {"plane", "plane", {-3.0, 1e-7}, 1.0 / 3.0},
};

void PrintTo(const Place& place, std::ostream* out) { *out << place.name; }

class RoundTrip : public ::testing::TestWithParam<std::tuple<GridFormat, Place>> {};

Grid writtenAndRead(const Grid& grid, const GridFormat& format) {
  const TemporaryFolder folder;
  const std::string path = folder / ("lakes" + endingOf(format));
  StagedOutput output(path, format, false);
  output.write(grid);
  output.commit();
  return readGrid(path);
}

TEST_P(RoundTrip, GivesTheSameGrid) {
  const auto& [format, place] = GetParam();
  const Grid grid = sampleGrid(parseCrs(place.crs), place.origin, place.size);
  expectSame(writtenAndRead(grid, format), grid, std::string(format.name));
}

TEST_P(RoundTrip, KeepsExtremeNumbers) {
  const auto& [format, place] = GetParam();
  Grid grid = sampleGrid(parseCrs(place.crs), place.origin, place.size);
  grid.nodes[0].y = 5e-324;  // the least positive number, one ulp above 1, and a number of many digits
  grid.nodes[1].y = 1.0000000000000002;
  grid.nodes[2].x = 1e-7 / 3.0;
  grid.z[0] = -1.7976931348623157e+308;
  const Grid got = writtenAndRead(grid, format);
  EXPECT_EQ(bitsOf(got.nodes), bitsOf(grid.nodes));
  EXPECT_EQ(bitsOf(got.z), bitsOf(grid.z));
}

// A gap in the depths is read back as a gap, or refused; it never becomes a number.
TEST_P(RoundTrip, KeepsGapsInZ) {
  const auto& [format, place] = GetParam();
  Grid grid = sampleGrid(parseCrs(place.crs), place.origin, place.size);
  grid.z[3] = grid.z.back() = std::numeric_limits<double>::quiet_NaN();
  const TemporaryFolder folder;
  const std::string path = folder / ("lakes" + endingOf(format));
  StagedOutput output(path, format, false);
  if (format.needs_depths) {
    EXPECT_THROW(output.write(grid), OutputError);
    return;
  }
  output.write(grid);
  output.commit();
  const Grid got = readGrid(path);
  ASSERT_EQ(got.z.size(), grid.z.size());
  for (std::size_t i = 0; i < grid.z.size(); ++i) {
    if (std::isnan(grid.z[i])) {
      EXPECT_TRUE(std::isnan(got.z[i])) << i << ' ' << got.z[i];
    } else {
      EXPECT_EQ(got.z[i], grid.z[i]) << i;
    }
  }
}

// `needs_depths` says so before a mesh is made, of formats that are not read too.
TEST(GridFormats, SayWhetherEachNodeNeedsADepth) {
  Grid grid = sampleGrid(wgs84(), {-87.5, 43.1}, 0.01);
  grid.z[3] = std::numeric_limits<double>::quiet_NaN();
  std::size_t needing = 0;
  for (const GridFormat& format : gridFormats()) {
    if (!format.writable || format.beside_grid) continue;
    const TemporaryFolder folder;
    StagedOutput output(folder / (format.endings.empty() ? "lakes.x" : "lakes" + endingOf(format)), format, false);
    std::string refusal;
    try {
      output.write(grid);
    } catch (const OutputError& error) {
      refusal = error.what();
    }
    EXPECT_EQ(refusal.find("is unknown, and the format cannot say that") != refusal.npos, format.needs_depths)
        << format.name << ": " << refusal;
    needing += format.needs_depths;
  }
  EXPECT_GE(needing, 12u);
}

// A number that marks a gap in some format is an ordinary depth.
TEST_P(RoundTrip, KeepsDepthsThatLookLikeGaps) {
  const auto& [format, place] = GetParam();
  Grid grid = sampleGrid(parseCrs(place.crs), place.origin, place.size);
  for (std::size_t i = 0; i < 4; ++i) grid.z[i] = std::array{-999.0, 999.0, -9999.0, -99999.0}[i];
  const Grid got = writtenAndRead(grid, format);
  ASSERT_EQ(got.z.size(), grid.z.size());
  for (std::size_t i = 0; i < grid.z.size(); ++i) EXPECT_NEAR(got.z[i], grid.z[i], 1e-12) << i;
}

// A bare grid: no z, features, boundaries or angles.
TEST_P(RoundTrip, InventsNothing) {
  const auto& [format, place] = GetParam();
  const Grid full = sampleGrid(parseCrs(place.crs), place.origin, place.size);
  Grid grid;
  grid.crs = full.crs;
  grid.nodes = full.nodes;
  grid.triangles = full.triangles;
  const Grid got = writtenAndRead(grid, format);
  EXPECT_EQ(bitsOf(got.nodes), bitsOf(grid.nodes));
  EXPECT_EQ(got.triangles, grid.triangles);
  EXPECT_TRUE(got.z.empty());
  if (impliesShores(std::string(format.name))) {
    for (const Boundary& boundary : got.boundaries) EXPECT_TRUE(boundary.closed && boundary.role != BoundaryRole::Open);
  } else {
    EXPECT_TRUE(got.boundaries.empty());
  }
  EXPECT_TRUE(got.features.empty());
  EXPECT_TRUE(got.feature_of.empty());
  EXPECT_TRUE(got.min_angle_deg.empty());
  EXPECT_TRUE(got.title.empty());
}

// Writing a grid twice gives the same bytes.
TEST_P(RoundTrip, IsDeterministic) {
  const auto& [format, place] = GetParam();
  const Grid grid = sampleGrid(parseCrs(place.crs), place.origin, place.size);
  const TemporaryFolder first, second;
  for (const TemporaryFolder* folder : {&first, &second}) {
    StagedOutput output(*folder / ("lakes" + endingOf(format)), format, false);
    output.write(grid);
    output.commit();
  }
  ASSERT_EQ(first.names(), second.names());
  for (const std::string& name : first.names()) {
    EXPECT_TRUE(bytesOf(first / name) == bytesOf(second / name)) << name;
  }
}

// Enough rows to be shared by threads, and enough for the large-file path of UGRID, written in file order or backwards.
TEST(GridFormats, HoldTheSameBytesInWhateverOrderTheyAreMade) {
  const Grid grid = testing::inParts(sampleGrid(parseCrs("EPSG:4326"), {-87.5, 43.1}, 0.001, 70));
  for (const GridFormat& format : gridFormats()) {
    if (!format.writable) continue;
    const TemporaryFolder first, second;
    for (const auto& [folder, loop] :
         {std::pair<const TemporaryFolder*, ItemLoop>{&first, inOrder}, {&second, testing::backwards}}) {
      StagedOutput output(*folder / ("lakes" + endingOf(format)), format, false);
      output.write(grid, loop);
      output.commit();
    }
    ASSERT_EQ(first.names(), second.names());
    for (const std::string& name : first.names()) EXPECT_TRUE(bytesOf(first / name) == bytesOf(second / name)) << name;
    if (!format.readable) continue;
    const Grid got = readGrid(second / ("lakes" + endingOf(format)));
    EXPECT_EQ(got.triangles, grid.triangles) << format.name;
    EXPECT_EQ(got.nodes.size(), grid.nodes.size()) << format.name;
  }
}

// Writing what was read gives the same bytes.
TEST_P(RoundTrip, WritesAgainWhatItReads) {
  const auto& [format, place] = GetParam();
  const Grid grid = sampleGrid(parseCrs(place.crs), place.origin, place.size);
  const TemporaryFolder first, second;
  const std::string name = "lakes" + endingOf(format);
  StagedOutput output(first / name, format, false);
  output.write(grid);
  output.commit();
  StagedOutput again(second / name, format, false);
  again.write(readGrid(first / name));
  again.commit();
  ASSERT_EQ(first.names(), second.names());
  for (const std::string& file : first.names()) EXPECT_TRUE(bytesOf(first / file) == bytesOf(second / file)) << file;
}

std::vector<GridFormat> formatsThatReadAndWrite() {
  std::vector<GridFormat> formats;
  for (const GridFormat& format : gridFormats())
    if (format.readable && format.writable &&
        (format.places == NodePlaces::AsTheyAre || format.places == NodePlaces::OneTurn))
      formats.push_back(format);
  return formats;
}

INSTANTIATE_TEST_SUITE_P(Formats, RoundTrip,
                         ::testing::Combine(::testing::ValuesIn(formatsThatReadAndWrite()),
                                            ::testing::ValuesIn(kPlaces)),
                         [](const auto& instance) {
                           return std::string("to_") + std::string(std::get<0>(instance.param).name) + "_" +
                                  std::get<1>(instance.param).name;
                         });

// Models would see triangles around the globe where longitudes jump, so their formats unwrap them. Layers, FESOM and 3D
// VTU stay within ±180.
TEST(GridFormats, OfModelsGoOnPastTheAntimeridian) {
  const Grid past = sampleGrid(wgs84(), {179.95, -16.6}, 0.01);
  Grid grid = past;
  for (Point& p : grid.nodes)
    if (p.x > 180.0) p.x -= 360.0;
  for (const GridFormat& format : gridFormats()) {
    if (!format.writable || !format.readable || format.places == NodePlaces::Sphere) continue;
    const TemporaryFolder folder;
    const std::string path = folder / ("lakes" + endingOf(format));
    StagedOutput output(path, format, false);
    output.write(grid);
    output.commit();
    const bool goes_on = format.name != "gpkg" && format.name != "geojson" && format.name != "shp" &&
                         format.name != "fgb" && format.name != "fesom" && format.name != "vtu3d";
    EXPECT_EQ(readGrid(path).nodes, goes_on ? past.nodes : grid.nodes) << format.name;
  }
}

// SCHISM's hgrid.ll is in degrees, whatever the CRS of the mesh.
TEST(GridFormats, LongitudesOfAProjectedGridGoOnToo) {
  const TemporaryFolder folder;
  StagedOutput output(folder / "hgrid.gr3", gridFormatFor("hgrid.gr3"), false);
  const Grid grid = sampleGrid(parseCrs("EPSG:3832"), {3.335e6, -1.9e6}, 1000.0);  // ±180 lies at 3,339,584 m
  output.write(grid);
  output.commit();
  const Grid degrees = readGrid(folder / "hgrid.ll");
  ASSERT_EQ(degrees.nodes.size(), grid.nodes.size());
  const auto [west, east] = std::ranges::minmax(degrees.nodes, {}, &Point::x);
  EXPECT_GT(west.x, 179.9);
  EXPECT_LT(west.x, 180.0);
  EXPECT_GT(east.x, 180.0);
  EXPECT_LT(east.x, 180.2);
  EXPECT_EQ(readGrid(folder / "hgrid.gr3").nodes, grid.nodes);
}

// Projections of UTM zones in other units, or with a datum shift: drivers must not take them for the zone itself.
TEST(GridFormats, KeepCrssThatHaveNoCode) {
  const TemporaryFolder folder;
  const std::vector<std::pair<std::string, double>> with_metres = {
      {"+proj=utm +zone=32 +datum=WGS84 +units=km", 1000.0},
      {"+proj=utm +zone=17 +datum=NAD83 +units=us-ft", 0.3048},
      {"+proj=utm +zone=32 +ellps=WGS84 +towgs84=100,0,0", 1.0}};
  for (const auto& [proj, metres] : with_metres) {
    const Grid grid = sampleGrid(parseCrs(proj), {500000.0 / metres, 5000000.0 / metres}, 100.0 / metres);
    for (const char* name : {"a.gpkg", "a.fgb"}) {
      const std::string path = folder / name;
      StagedOutput output(path, gridFormatFor(path), true);
      output.write(grid);
      output.commit();
      EXPECT_TRUE(sameCrs(readGrid(path).crs, grid.crs)) << name << ' ' << proj;
    }
  }
}

// GDAL calls it an error that WKT 1 cannot express Equal Earth or a datum shift by a grid, and then writes WKT 2.
TEST(GridFormats, KeepCrssThatOnlyWkt2CanExpress) {
  const TemporaryFolder folder;
  for (const char* text : {"EPSG:8857", "+proj=eqearth +lon_0=20 +R=6371000",
                           "+proj=utm +zone=32 +ellps=intl +nadgrids=@null +type=crs"}) {
    const Grid grid = sampleGrid(parseCrs(text), {500000.0, 5000000.0}, 100.0);
    for (const char* name : {"a.gpkg", "a.fgb"}) {
      const std::string path = folder / name;
      StagedOutput output(path, gridFormatFor(path), true);
      output.write(grid);
      output.commit();
      EXPECT_TRUE(sameCrs(readGrid(path).crs, grid.crs)) << name << ' ' << text;
    }
  }
}

// Files with longitudes but without a CRS are in WGS 84, whatever the prime meridian and datum of the mesh.
TEST(GridFormats, LongitudesWithoutACrsAreThoseOfWgs84) {
  const TemporaryFolder folder;
  for (const char* code : {"EPSG:31281", "EPSG:27572", "EPSG:4230"}) {  // from Ferro, from Paris, ED50
    const Crs crs = parseCrs(code);
    const CrsMap map(toOgr(wgs84()), toOgr(crs));
    const Point origin = map.forward({10.0, 47.0});
    const Grid grid = sampleGrid(crs, origin, crs.geographic ? 0.01 : 1000.0);
    const std::string path = folder / "a_mpas.nc";
    StagedOutput output(path, gridFormatFor(path), true);
    output.write(grid);
    output.commit();
    const Grid got = readGrid(path);
    ASSERT_EQ(got.nodes.size(), grid.nodes.size());
    for (std::size_t i = 0; i < got.nodes.size(); ++i) {
      const Point expected = map.inverse(grid.nodes[i]);
      EXPECT_NEAR(got.nodes[i].x, expected.x, 1e-8) << code;
      EXPECT_NEAR(got.nodes[i].y, expected.y, 1e-8) << code;
    }
  }
}

// Longitudes that a file holds besides coordinates of the CRS, and those of a globe, are in WGS 84 too.
TEST(GridFormats, LongitudesBesideACrsAreThoseOfWgs84) {
  const TemporaryFolder folder;
  const Crs tokyo = parseCrs("EPSG:4301");  // some 400 m from WGS 84
  const CrsMap map(toOgr(tokyo), toOgr(wgs84()));
  const Grid grid = sampleGrid(tokyo, {139.8, 35.5}, 0.01);
  for (const char* name : {"a.gr3", "a_globe.vtu"}) {
    StagedOutput output(folder / name, gridFormatFor(name), true);
    output.write(grid);
    output.commit();
  }
  for (const char* name : {"a.ll", "a_globe.vtu"}) {
    const Grid got = readGrid(folder / name);
    EXPECT_TRUE(sameCrs(got.crs, wgs84())) << name;
    ASSERT_EQ(got.nodes.size(), grid.nodes.size());
    for (std::size_t i = 0; i < got.nodes.size(); ++i) EXPECT_EQ(got.nodes[i], map.forward(grid.nodes[i])) << name;
  }
  EXPECT_EQ(folder.names(), (std::vector<std::string>{"a.gr3", "a.ll", "a.prj", "a_globe.vtu"}));
  EXPECT_TRUE(sameCrs(readGrid(folder / "a.gr3").crs, tokyo));
  EXPECT_TRUE(sameCrs(readGrid(folder / "a.ll", tokyo).crs, tokyo));  // as the user says
}

TEST(GridFormats, AreChosenByEndingOrName) {
  EXPECT_EQ(gridFormatFor("a/b.GPKG").name, "gpkg");
  EXPECT_EQ(gridFormatFor("lake.1.ele").name, "triangle");
  EXPECT_EQ(gridFormatFor("lake.msh", "gmsh22").name, "gmsh22");
  EXPECT_EQ(gridFormatFor("lake.msh").name, "gmsh");
  EXPECT_EQ(gridFormatFor("lake_ww3.msh").name, "ww3");
  EXPECT_EQ(gridFormatFor("fort.14").name, "adcirc");
  EXPECT_EQ(gridFormatFor("run/hgrid.ll").name, "schism");
  EXPECT_EQ(gridFormatFor("tst_grd.dat").name, "fvcom");
  EXPECT_EQ(gridFormatFor("lake_net.nc").name, "ugrid");
  EXPECT_EQ(gridFormatFor("mesh/nod2d.out").name, "fesom");
  EXPECT_THROW(gridFormatFor("lake.xyz"), OutputError);
  EXPECT_THROW(gridFormatFor("lake"), OutputError);
  EXPECT_THROW(gridFormatFor("lake.nc", "grib"), OutputError);
}

}  // namespace
}  // namespace coastmesh
