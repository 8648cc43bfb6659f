// Nodal attributes from rasters and tables, in files of models and under edits.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/cli/lake_with_depths.hpp"

namespace coastmesh::test {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::json;

class Attributes : public LakeWithDepths {
 protected:
  // A raster whose values rise evenly eastwards, so that all edits have to make the same.
  std::string evenRaster() const {
    std::string text = "ncols 60\nnrows 40\nxllcorner -87.52\nyllcorner 41.58\ncellsize 0.0015\n";
    for (int row = 0; row < 40; ++row) {
      for (int column = 0; column < 60; ++column) text += std::to_string(10 + column) + " ";
      text += "\n";
    }
    return write("even.asc", text);
  }
  static double evenAt(double lon) { return 10.0 + (lon + 87.52) / 0.0015 - 0.5; }

  // The lake with the attribute "a" of that raster.
  std::string evenMesh(const std::string& name, const std::string& size_m) const {
    const ProgramRun run = runProgram({"mesh", lake(), "-o", file(name), "--size-max", size_m, "--bathymetry", dem(),
                                       "--attribute", "a=" + evenRaster(), "--quiet", "--overwrite"});
    EXPECT_EQ(run.code, 0) << run.errors;
    return file(name);
  }

  using Place = std::pair<double, double>;
  // The places of a fort.14, and the values of an attribute in the fort.13 beside it, as ADCIRC reads both.
  static std::vector<Place> placesIn(const std::string& path) {
    std::istringstream text(readText(path));
    std::string title;
    std::getline(text, title);
    std::size_t elements = 0, nodes = 0, number = 0;
    text >> elements >> nodes;
    std::vector<Place> places(nodes);
    double depth = 0.0;
    for (std::size_t i = 0; i < nodes; ++i) {
      text >> number >> places[i].first >> places[i].second >> depth;
      EXPECT_EQ(number, i + 1);
    }
    return places;
  }
  static std::vector<double> valuesIn(const std::string& path, const std::string& wanted) {
    std::istringstream text(readText(path));
    std::string name, unit;
    std::getline(text, name);
    std::size_t nodes = 0, attributes = 0, each = 0;
    text >> nodes >> attributes;
    std::map<std::string, std::vector<double>> values;
    for (std::size_t i = 0; i < attributes; ++i) {
      double usual = 0.0;
      std::getline(text >> std::ws, name);
      std::getline(text, unit);
      text >> each >> usual;
      EXPECT_EQ(each, 1u);
      values[name].assign(nodes, usual);
    }
    for (std::size_t i = 0; i < attributes; ++i) {
      std::size_t rows = 0, node = 0;
      std::getline(text >> std::ws, name);
      text >> rows;
      for (std::size_t k = 0; k < rows; ++k) {
        text >> node;
        text >> values.at(name).at(node - 1);
      }
    }
    EXPECT_TRUE(text.good());
    EXPECT_EQ((text >> name).rdstate() & std::ios::eofbit, std::ios::eofbit);
    return values.at(wanted);
  }
  // Expects the even values everywhere in a result of an edit, and returns the number of its nodes.
  std::size_t expectEven(const std::string& name) const {
    const ProgramRun run = runProgram({"convert", file(name), "-o", file("seen.14"), "--overwrite", "--quiet"});
    EXPECT_EQ(run.code, 0) << run.errors;
    const std::vector<Place> places = placesIn(file("seen.14"));
    const std::vector<double> values = valuesIn(file("seen.13"), "a");
    EXPECT_EQ(places.size(), values.size());
    double worst = 0.0;
    for (std::size_t i = 0; i < std::min(places.size(), values.size()); ++i)
      worst = std::max(worst, std::abs(values[i] - evenAt(places[i].first)));
    EXPECT_LT(worst, 1e-3);
    return places.size();
  }
};

TEST_F(Attributes, OfClassesAreInAllFilesOfModels) {
  std::string cover = "ncols 2\nnrows 1\nxllcorner -87.5201\nyllcorner 41.59\ncellsize 0.03\nNODATA_value 0\n11 21\n";
  const std::string raster = write("cover.asc", cover), table = write("n.csv", "class,n\n11,0.02\n21,0.1\n");
  const ProgramRun run = runProgram({"mesh", lake(), "--attribute", "manning=" + raster + "," + table, "--attribute",
                                     "canopy=1", "-o", file("hgrid.gr3"), "-o", file("fort.14"), "-o", file("a.nc"),
                                     "-o", file("a.slf"), "--report", file("a.json")});
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.output, AllOf(HasSubstr("mannings_n_at_sea_floor from 0.02 to 0.1; 0 nodes filled, 0 unknown"),
                                HasSubstr("surface_canopy_coefficient from 1 to 1")));
  const std::vector<Place> places = placesIn(file("fort.14"));
  const std::vector<double> manning = valuesIn(file("fort.13"), "mannings_n_at_sea_floor");
  ASSERT_EQ(places.size(), manning.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    EXPECT_EQ(manning[i], places[i].first < -87.4901 ? 0.02 : 0.1) << places[i].first;
  for (const double value : valuesIn(file("fort.13"), "surface_canopy_coefficient")) EXPECT_EQ(value, 1.0);
  const std::vector<std::string> lines = linesOf(file("manning.gr3"));
  for (std::size_t i = 0; i < places.size(); ++i) {
    std::istringstream line(lines[2 + i]);
    std::vector<double> row(4);
    for (double& number : row) line >> number;
    EXPECT_THAT(row, ElementsAre(static_cast<double>(i + 1), places[i].first, places[i].second, manning[i]));
  }
  EXPECT_TRUE(names().contains("canopy.gr3"));
  const Json report = Json::parse(readText(file("a.json")))["attributes"];
  EXPECT_EQ(report[0]["files"][0]["table"], table);
  EXPECT_EQ(report[0]["files"][0]["nodes"], places.size());
  EXPECT_EQ(report[1]["of_number"], places.size());
  // All of them read back alike.
  for (const char* const name : {"fort.14", "a.nc", "a.slf", "hgrid.gr3"}) {
    const ProgramRun info = runProgram({"info", file(name), "--json"});
    const Json attributes = Json::parse(info.output)["attributes"];
    EXPECT_EQ(attributes[0]["name"], "mannings_n_at_sea_floor") << name;
    EXPECT_EQ(attributes[0]["least"], 0.02) << name;
    EXPECT_EQ(attributes[0]["greatest"], 0.1) << name;
  }
}

TEST_F(Attributes, AreKeptByConvertAndCut) {
  const std::size_t all = expectEven(std::filesystem::path(evenMesh("a.nc", "300")).filename());
  const ProgramRun converted = runProgram({"convert", file("a.nc"), "-o", file("b.14")});
  EXPECT_EQ(converted.code, 0);
  EXPECT_THAT(converted.errors, Not(HasSubstr("attribute")));
  ASSERT_EQ(runProgram({"cut", file("b.14"), box(), "-o", file("c.nc")}).code, 0);
  const std::size_t part = expectEven("c.nc");
  EXPECT_GT(part, 10u);
  EXPECT_LT(part, all);
}

TEST_F(Attributes, AreLinearInNewTriangles) {
  const std::size_t before = expectEven(std::filesystem::path(evenMesh("a.nc", "300")).filename());
  const ProgramRun run = runProgram({"remesh", file("a.nc"), box(), "--size", "60", "-o", file("b.nc")});
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_GT(expectEven("b.nc"), 2 * before);
}

TEST_F(Attributes, OfMergedMeshesAreThoseOfEach) {
  evenMesh("a.nc", "300");
  evenMesh("fine.nc", "80");
  ASSERT_EQ(runProgram({"cut", file("fine.nc"), box(), "-o", file("part.nc")}).code, 0);
  const ProgramRun run = runProgram({"merge", file("a.nc"), file("part.nc"), "-o", file("b.nc")});
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.errors, Not(HasSubstr("has no a")));
  expectEven("b.nc");
}

TEST_F(Attributes, APartWithoutOneGetsTheDefault) {
  evenMesh("a.nc", "300");
  ASSERT_EQ(runProgram({"cut", meshOf("fine.nc", "80"), box(), "-o", file("part.nc")}).code, 0);
  ASSERT_EQ(
      runProgram({"convert", file("part.nc"), "-o", file("with.nc"), "--attribute", "manning=0.03", "--quiet"}).code,
      0);
  const ProgramRun run = runProgram({"merge", file("a.nc"), file("with.nc"), "-o", file("b.14")});
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_THAT(run.errors, AllOf(HasSubstr("with.nc' has no a: its nodes get the default, "),
                                HasSubstr("a.nc' has no mannings_n_at_sea_floor: its nodes get the default, 0.03")));
  for (const double value : valuesIn(file("b.13"), "mannings_n_at_sea_floor")) EXPECT_EQ(value, 0.03);
}

TEST_F(Attributes, GoOnAlongRivers) {
  evenMesh("a.nc", "300");
  write("rivers.csv", "WKT,width\n\"LINESTRING (-87.481 41.613, -87.47 41.6175, -87.46 41.619)\",60\n");
  const ProgramRun run = runProgram({"rivers", file("a.nc"), file("rivers.csv"), "-o", file("b.nc")});
  ASSERT_EQ(run.code, 0) << run.errors;
  ASSERT_EQ(runProgram({"convert", file("b.nc"), "-o", file("b.14"), "--quiet"}).code, 0);
  const std::vector<Place> places = placesIn(file("b.14"));
  const std::vector<double> values = valuesIn(file("b.13"), "a");
  std::size_t outside = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    const bool in_lake = places[i].first < -87.483;
    if (in_lake) {
      EXPECT_NEAR(values[i], evenAt(places[i].first), 1e-3);
    }
    outside += in_lake ? 0 : 1;
    EXPECT_GE(values[i], 10.0);
    EXPECT_LE(values[i], evenAt(-87.4749));
  }
  EXPECT_GT(outside, 20u);
}

TEST_F(Attributes, AreMadeForNodesOfRepairs) {
  const ProgramRun run =
      runProgram({"mesh", lake(), "-o", file("a.14"), "--size", "150", "--bathymetry", dem(), "--attribute",
                  "a=" + evenRaster(), "--target", "adcirc", "--time-step", "12", "--quiet"});
  ASSERT_THAT(run.code, ::testing::AnyOf(0, 1)) << run.errors;
  expectEven("a.14");
}

TEST_F(Attributes, ShardsGatheredHaveThoseOfOneRun) {
  const std::vector<std::string> job{"mesh", lake(), "--size-max", "300", "--attribute", "a=" + evenRaster()};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = job;
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  ASSERT_EQ(runProgram(with({"-o", file("one.14")})).code, 0);
  ASSERT_EQ(runProgram(with({"--shard", "1/1", "-o", file("a.shard")})).code, 0);
  const ProgramRun run = runProgram({"gather", file("a.shard"), "-o", file("two.14")});
  ASSERT_EQ(run.code, 0) << run.errors;
  EXPECT_EQ(readText(file("one.13")), readText(file("two.13")));
}

TEST_F(Attributes, FormatsThatCannotHoldThemSaySo) {
  const ProgramRun run = runProgram({"convert", evenMesh("a.nc", "300"), "-o", file("a.2dm")});
  EXPECT_THAT(run.errors, HasSubstr("the nodal attribute a"));
}

TEST_F(Attributes, WrongOnesAreRefused) {
  const auto refusal = [&](const std::string& value, int code) {
    const ProgramRun run = runProgram({"mesh", lake(), "-o", file("a.14"), "--attribute", value});
    EXPECT_EQ(run.code, code) << value;
    EXPECT_TRUE(isOneErrorLine(run.errors)) << run.errors;
    EXPECT_TRUE(!names().contains("a.14") && !names().contains("a.13"));
    return run.errors;
  };
  EXPECT_THAT(refusal("manning", 2), HasSubstr("--attribute"));
  EXPECT_THAT(refusal("depth=1", 2), HasSubstr("--bathymetry"));
  EXPECT_THAT(refusal("manning=none.tif", 3), HasSubstr("none.tif"));
  const std::string raster = write("cover.asc", "ncols 1\nnrows 1\nxllcorner -88\nyllcorner 41\ncellsize 1\n7\n");
  EXPECT_THAT(refusal("manning=" + raster + "," + write("n.csv", "1,2\n"), 3),
              HasSubstr("has class 7 at (-87.5, 41.5)"));
  // The files of FVCOM need both attributes of a sponge: without one, there is no need to read the input.
  const ProgramRun sponge = runProgram(
      {"mesh", file("none.shp"), "-o", file("a.nc"), "-o", file("a_grd.dat"), "--attribute", "sponge_radius=3000"});
  EXPECT_EQ(sponge.code, 2);
  EXPECT_THAT(sponge.errors, HasSubstr("the sponge in '" + file("a_grd.dat") + "' needs sponge_coefficient too"));
  // An output may not replace a table.
  const ProgramRun run = runProgram({"mesh", lake(), "-o", file("n.csv"), "--format", "2dm", "--overwrite",
                                     "--attribute", "manning=" + raster + "," + file("n.csv")});
  EXPECT_EQ(run.code, 2);
  EXPECT_EQ(readText(file("n.csv")), "1,2\n");
}

TEST_F(Attributes, WithoutAValueHaveToBeGivenANumber) {
  const std::string west = write("west.asc", "ncols 1\nnrows 1\nxllcorner -88.49\nyllcorner 41\ncellsize 1\n7\n");
  const std::vector<std::string> job{"mesh", lake(), "--attribute", "a=" + west, "--depth-fill", "none", "-o"};
  const auto with = [&](const std::vector<std::string>& more) {
    std::vector<std::string> all = job;
    all.insert(all.end(), more.begin(), more.end());
    return runProgram(all);
  };
  const ProgramRun run = with({file("a.14")});
  EXPECT_EQ(run.code, 4);
  EXPECT_THAT(run.errors, HasSubstr("give --attribute a= a number for nodes without a value"));
  EXPECT_EQ(with({file("b.14"), "--attribute", "a=0.5"}).code, 0);
  const std::vector<double> values = valuesIn(file("b.13"), "a");
  const std::vector<Place> places = placesIn(file("b.14"));
  for (std::size_t i = 0; i < values.size(); ++i) EXPECT_EQ(values[i], places[i].first <= -87.49 ? 7.0 : 0.5);
}

}  // namespace
}  // namespace coastmesh::test
