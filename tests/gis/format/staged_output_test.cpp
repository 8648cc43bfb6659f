// An output appears complete or not at all, and replaces another only with permission.
#include <gdal_priv.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <ogrsf_frmts.h>
#include <sys/resource.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>

#include "gis/error.hpp"
#include "gis/file/prj_file.hpp"
#include "gis/format/grid_io.hpp"
#include "gis/format/grid_losses.hpp"
#include "gis/format/write_ogr.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using testing::sampleGrid;
using testing::TemporaryFolder;

Grid lakes(const char* crs = "EPSG:4326", int cells = 4) {
  return testing::inParts(sampleGrid(parseCrs(crs), {-87.5, 43.1}, 0.01, cells));
}

std::string endingOf(const GridFormat& format) {
  return format.endings.empty() ? ".msh" : std::string(format.endings.front());
}

void put(const std::string& path, const std::string& text) { std::ofstream(path) << text; }

std::string textOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void writeWhole(const std::string& path, const Grid& grid, bool overwrite = false) {
  StagedOutput output(path, gridFormatFor(path), overwrite);
  output.write(grid);
  output.commit();
}

template <typename Act>
std::string errorOf(Act act) {
  try {
    act();
  } catch (const OutputError& error) {
    return error.what();
  }
  return "no error";
}

// While this exists, no file may grow beyond `bytes`, which simulates a full disk.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before_);
    signal_before_ = std::signal(SIGXFSZ, SIG_IGN);
    rlimit limit = before_;
    limit.rlim_cur = bytes;
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, signal_before_);
  }

 private:
  rlimit before_{};
  void (*signal_before_)(int) = nullptr;
};

std::vector<GridFormat> writableFormats() {
  std::vector<GridFormat> formats;
  for (const GridFormat& format : gridFormats())
    if (format.writable) formats.push_back(format);
  return formats;
}

class StagedFormats : public ::testing::TestWithParam<GridFormat> {};

TEST_P(StagedFormats, NothingShowsBeforeCommit) {
  const TemporaryFolder folder;
  const std::string path = folder / ("lake" + endingOf(GetParam()));
  {
    StagedOutput output(path, GetParam(), false);
    output.write(lakes());
    EXPECT_THAT(folder.names(), ElementsAre(HasSubstr(".part-")));
  }
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST_P(StagedFormats, CommitLeavesOnlyTheOutput) {
  const TemporaryFolder folder;
  StagedOutput output(folder / ("lake" + endingOf(GetParam())), GetParam(), false);
  output.write(lakes());
  output.commit();
  EXPECT_THAT(folder.names(), Not(IsEmpty()));
  for (const std::string& name : folder.names()) EXPECT_TRUE(name.starts_with("lake")) << name;
}

// The disk may become full anywhere, even at the last byte.
TEST_P(StagedFormats, AFullDiskLeavesNothingAndSaysSo) {
  const TemporaryFolder folder, whole;
  const std::string name = "lake" + endingOf(GetParam());
  const Grid grid = lakes("EPSG:4326", 10);
  StagedOutput complete(whole / name, GetParam(), false);
  complete.write(grid);
  complete.commit();
  std::uintmax_t largest = 0;
  for (const std::string& file : whole.names()) largest = std::max(largest, std::filesystem::file_size(whole / file));

  constexpr int kLimits = 12;
  for (int i = 1; i <= kLimits; ++i) {
    ::testing::internal::CaptureStderr();
    std::string error;
    {
      const FileSizeLimit limit(i == kLimits ? largest - 1 : largest * i / kLimits);
      error = errorOf([&] {
        StagedOutput output(folder / name, GetParam(), false);
        output.write(grid);
        output.commit();
      });
    }
    EXPECT_EQ(::testing::internal::GetCapturedStderr(), "") << i;
    EXPECT_THAT(error, AllOf(HasSubstr("cannot write '" + (folder / "lake")), Not(HasSubstr(".part-")))) << i;
    EXPECT_THAT(error, HasSubstr(std::strerror(EFBIG))) << i;  // whatever the library says
    EXPECT_THAT(folder.names(), IsEmpty()) << i;
  }
}

TEST_P(StagedFormats, AnExistingTargetIsKept) {
  const TemporaryFolder folder;
  const std::string path = folder / ("lake" + endingOf(GetParam()));
  put(path, "precious");
  EXPECT_THAT(errorOf([&] { StagedOutput(path, GetParam(), false); }),
              AllOf(HasSubstr(path), HasSubstr("--overwrite")));
  EXPECT_EQ(textOf(path), "precious");
}

TEST_P(StagedFormats, ATargetThatComesMeanwhileIsKept) {
  const TemporaryFolder folder;
  const std::string path = folder / ("lake" + endingOf(GetParam()));
  {
    StagedOutput output(path, GetParam(), false);
    output.write(lakes());
    put(path, "precious");
    EXPECT_THAT(errorOf([&] { output.commit(); }), HasSubstr("--overwrite"));
  }
  EXPECT_EQ(textOf(path), "precious");
  EXPECT_EQ(folder.names().size(), 1u);
}

TEST_P(StagedFormats, OverwriteReplacesAll) {
  const TemporaryFolder folder, fresh;
  const std::string name = "lake" + endingOf(GetParam());
  for (const std::string& path : {folder / name, folder / name, fresh / name}) {
    StagedOutput output(path, GetParam(), true);
    output.write(path == fresh / name ? lakes() : lakes("EPSG:4326", path == folder / name ? 4 : 5));
    output.commit();
  }
  ASSERT_EQ(folder.names(), fresh.names());
  for (const std::string& file : folder.names()) EXPECT_TRUE(textOf(folder / file) == textOf(fresh / file)) << file;
}

INSTANTIATE_TEST_SUITE_P(Formats, StagedFormats, ::testing::ValuesIn(writableFormats()),
                         [](const auto& instance) { return "as_" + std::string(instance.param.name); });

TEST(StagedOutput, RefusesMissingFoldersAndFoldersAsTargets) {
  const TemporaryFolder folder;
  EXPECT_THAT(errorOf([&] { writeWhole(folder / "no/lake.gpkg", lakes()); }), HasSubstr("there is no folder"));
  std::filesystem::create_directory(folder / "lake.msh");
  EXPECT_THAT(errorOf([&] { writeWhole(folder / "lake.msh", lakes(), true); }), HasSubstr("it is a folder"));
  EXPECT_THAT(errorOf([&] { writeWhole(folder / (std::string(400, 'n') + ".nc"), lakes()); }), HasSubstr("too long"));
  EXPECT_THAT(folder.names(), ElementsAre("lake.msh"));
}

TEST(StagedOutput, RefusesAMeshWithoutTriangles) {
  const TemporaryFolder folder;
  EXPECT_THAT(errorOf([&] { writeWhole(folder / "lake.nc", Grid()); }), HasSubstr("no triangles"));
  EXPECT_THAT(folder.names(), IsEmpty());
}

// The last of the files cannot be moved into place: the others are removed, and what was there before is restored.
TEST(StagedOutput, CommitOfSeveralFilesIsAllOrNothing) {
  const TemporaryFolder folder;
  writeWhole(folder / "lake.node", lakes());
  const std::string before = textOf(folder / "lake.node");
  std::filesystem::create_directory(folder / "zone");
  {
    StagedOutput output(folder / "lake.node", gridFormatFor("lake.node"), true);
    output.write(lakes("EPSG:4326", 5));
    put(output.stagingFolder() + "/zone", "cannot take the place of a folder");
    EXPECT_THAT(errorOf([&] { output.commit(); }), HasSubstr(folder / "zone"));
  }
  EXPECT_EQ(textOf(folder / "lake.node"), before);
  EXPECT_THAT(folder.names(), ElementsAre("lake.ele", "lake.node", "lake.poly", "lake.prj", "zone"));
}

TEST(StagedOutput, NeverReplacesAFolder) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "lake.poly");
  EXPECT_THAT(errorOf([&] { writeWhole(folder / "lake.node", lakes(), true); }), HasSubstr("it is a folder"));
  EXPECT_THAT(folder.names(), ElementsAre("lake.poly"));
}

TEST(StagedOutput, OverwritingAShapefileRemovesItsIndexes) {
  const TemporaryFolder folder;
  writeWhole(folder / "lake.shp", lakes());
  for (const char* stale : {"lake.qix", "lake_nodes.sbn", "lake.shp.xml"}) put(folder / stale, "old");
  put(folder / "lake.txt", "precious");
  Grid plane = lakes();
  plane.crs = {};
  writeWhole(folder / "lake.shp", plane, true);
  EXPECT_THAT(folder.names(),
              ElementsAre("lake.cpg", "lake.dbf", "lake.shp", "lake.shx", "lake.txt", "lake_boundaries.cpg",
                          "lake_boundaries.dbf", "lake_boundaries.shp", "lake_boundaries.shx", "lake_nodes.cpg",
                          "lake_nodes.dbf", "lake_nodes.shp", "lake_nodes.shx"));
}

// SQLite would replay the old file's log into the new one.
TEST(StagedOutput, OverwritingAGeoPackageRemovesItsLogs) {
  const TemporaryFolder folder;
  for (const char* stale : {"lake.gpkg", "lake.gpkg-wal", "lake.gpkg-shm", "lake.gpkg-journal"})
    put(folder / stale, "old");
  writeWhole(folder / "lake.gpkg", lakes(), true);
  EXPECT_THAT(folder.names(), ElementsAre("lake.gpkg"));
}

// A GeoPackage with layers of the user, beside those of a mesh or not, is no file that a mesh may replace.
TEST(StagedOutput, NeverReplacesAGeoPackageWithOtherLayers) {
  const TemporaryFolder folder;
  const std::string path = folder / "project.gpkg";
  writeWhole(path, lakes());
  const auto addLayer = [&](const char* name) {
    const std::unique_ptr<GDALDataset> dataset(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR | GDAL_OF_UPDATE));
    ASSERT_TRUE(dataset);
    ASSERT_NE(dataset->CreateLayer(name, nullptr, wkbPoint), nullptr);
  };
  addLayer("layer_styles");
  writeWhole(path, lakes(), true);
  addLayer("stations");
  const std::string before = textOf(path);
  EXPECT_THAT(errorOf([&] { writeWhole(path, lakes(), true); }),
              AllOf(HasSubstr("project.gpkg' holds other layers (stations)"), HasSubstr("another name")));
  EXPECT_EQ(textOf(path), before);
  EXPECT_THAT(folder.names(), ElementsAre("project.gpkg"));
}

// "lake.shp" meshed to "lake.2dm": the .prj applies to both.
TEST(StagedOutput, KeepsAPrjThatSaysTheSame) {
  const TemporaryFolder folder;
  const std::string esri = R"(GEOGCS["GCS_WGS_1984",DATUM["D_WGS_1984",SPHEROID["WGS_1984",6378137.0,298.257223563]],)"
                           R"(PRIMEM["Greenwich",0.0], UNIT["Degree",0.0174532925199433]])";
  put(folder / "lake.shp", "someone's");
  put(folder / "lake.prj", esri);
  writeWhole(folder / "lake.2dm", lakes());
  EXPECT_EQ(textOf(folder / "lake.prj"), esri);
  EXPECT_EQ(readGrid(folder / "lake.2dm").crs.authority, "EPSG:4326");
}

TEST(StagedOutput, NeverReplacesThePrjOfAShapefile) {
  const TemporaryFolder folder;
  put(folder / "lake.shp", "someone's");
  writePrjBeside(folder / "lake.prj", parseCrs("EPSG:32616"));
  const std::string prj = textOf(folder / "lake.prj");
  EXPECT_THAT(errorOf([&] { writeWhole(folder / "lake.2dm", lakes()); }), HasSubstr("--overwrite"));
  EXPECT_THAT(errorOf([&] { writeWhole(folder / "lake.2dm", lakes(), true); }), HasSubstr("another CRS"));
  Grid plane = lakes();
  plane.crs = {};
  EXPECT_THAT(errorOf([&] { writeWhole(folder / "lake.2dm", plane, true); }), HasSubstr("another CRS"));
  EXPECT_EQ(textOf(folder / "lake.prj"), prj);
  EXPECT_THAT(folder.names(), ElementsAre("lake.prj", "lake.shp"));
}

TEST(StagedOutput, OverwritingWithAPlaneTakesThePrjAway) {
  const TemporaryFolder folder;
  writeWhole(folder / "lake.2dm", lakes());
  Grid plane = lakes();
  plane.crs = {};
  writeWhole(folder / "lake.2dm", plane, true);
  EXPECT_THAT(folder.names(), ElementsAre("lake.2dm"));
  EXPECT_TRUE(readGrid(folder / "lake.2dm").crs.isPlane());
}

TEST(StagedOutput, CanBeMoved) {
  const TemporaryFolder folder;
  std::vector<StagedOutput> outputs;
  for (const char* name : {"a.nc", "b.2dm", "c.msh"}) outputs.emplace_back(folder / name, gridFormatFor(name), false);
  for (StagedOutput& output : outputs) output.write(lakes());
  for (StagedOutput& output : outputs) output.commit();
  EXPECT_THAT(folder.names(), ElementsAre("a.nc", "b.2dm", "b.prj", "c.msh", "c.prj"));
}

TEST(StagedOutput, GeoJsonRefusesACrsThatItCannotName) {
  const TemporaryFolder folder;
  Grid grid = lakes();
  grid.crs = parseCrs("+proj=laea +lat_0=44 +lon_0=-87 +ellps=GRS80");
  EXPECT_THAT(errorOf([&] { writeWhole(folder / "lake.geojson", grid); }), HasSubstr(".gpkg"));
  EXPECT_THAT(folder.names(), IsEmpty());
}

// Without it the mesh would be read as one in a plane.
TEST(StagedOutput, ShapefilesRefuseACrsThatAPrjCannotHold) {
  const TemporaryFolder folder;
  Grid grid = lakes();
  grid.crs = parseCrs(
      "+proj=ob_tran +o_proj=longlat +o_lon_p=-162 +o_lat_p=39.25 +lon_0=180 +to_meter=0.0174532925199433 +type=crs");
  for (const char* name : {"lake.shp", "lake.14"})
    EXPECT_THAT(errorOf([&] { writeWhole(folder / name, grid); }), HasSubstr("no form for a .prj")) << name;
  EXPECT_THAT(folder.names(), IsEmpty());
}

TEST(StagedOutput, ADatumShiftIsALossWhereAPrjHasTheCrs) {
  Grid grid = lakes();
  const std::string bessel = "+proj=utm +zone=33 +ellps=bessel +units=m +type=crs";
  for (const auto& [crs, has_shift] :
       {std::pair(bessel + " +towgs84=598.1,73.7,418.2,0.202,0.045,-2.455,6.7", true),
        std::pair(bessel + " +nadgrids=other.gsb", true), std::pair(bessel + " +towgs84=0,0,0", false),
        std::pair(bessel, false), std::pair(std::string("EPSG:31467"), false),
        std::pair(std::string("plane"), false)}) {
    grid.crs = parseCrs(crs);
    for (const char* name : {"lake.14", "lake.shp", "lake.gr3", "lake_grd.dat", "lake.nc", "lake.gpkg", "lake.fgb"}) {
      const std::string losses = lossesIn(grid, gridFormatFor(name, ""), LossesOf::Input);
      const bool has_prj = !std::string(name).ends_with(".nc") && !std::string(name).ends_with(".gpkg") &&
                           !std::string(name).ends_with(".fgb");
      EXPECT_EQ(losses.find("datum shift") != std::string::npos, has_shift && has_prj) << crs << ", " << name;
    }
  }
}

TEST(StagedOutput, GeoJsonIsJsonWhateverNamesHold) {
  const TemporaryFolder folder;
  Grid grid = lakes();
  grid.features.front().attributes = {{"name", "a \"lake\" \\ of\x01\n\xff bytes, \xc3\xa4"}};
  writeWhole(folder / "lake.geojson", grid);
  const auto json = nlohmann::json::parse(textOf(folder / "lake.geojson"));  // throws unless it is UTF-8
  std::set<std::string> names;
  for (const auto& feature : json["features"])
    if (feature["properties"]["name"].is_string()) names.insert(feature["properties"]["name"]);
  EXPECT_EQ(names.count("a \"lake\" \\ of\x01\n\xef\xbf\xbd bytes, \xc3\xa4"), 1u);
}

TEST(Shapefile, RefusesMoreThanItsOffsetsHold) {
  EXPECT_NO_THROW(requireShapefileSize("lake.shp", 10'000'000, 120, 100));
  EXPECT_THROW(requireShapefileSize("lake.shp", 18'000'000, 120, 100), OutputError);
  EXPECT_THAT(errorOf([] { requireShapefileSize("lake.shp", 10'000'000, 120, 300); }), HasSubstr(".gpkg"));
}

}  // namespace
}  // namespace coastmesh
