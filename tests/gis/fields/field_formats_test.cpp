// Nodal attributes in files: their text, read strictly, and round trips.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>

#include "gis/error.hpp"
#include "gis/fields/node_fields.hpp"
#include "gis/format/grid_io.hpp"
#include "gis/format/grid_losses.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using testing::TemporaryFolder;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// Two triangles, with two attributes of which one has two values for each node.
Grid twoTriangles() {
  Grid grid;
  grid.title = "two triangles";
  grid.nodes = {{0, 0}, {100, 0}, {100, 100}, {0, 100}};
  grid.z = {-1, -2, -3, -4};
  grid.triangles = {{0, 1, 2}, {0, 2, 3}};
  grid.boundaries = {{BoundaryRole::Land, true, {0, 1, 2, 3}}};
  grid.node_fields = {{"mannings_n_at_sea_floor", "s/m^(1/3)", 0, kUnknown, {0.02, 0.1, 0.02, 0.025}},
                      {"two_values", "m", 1, 0.5, {0.5, 0.5, 7, 0.5}},
                      {"two_values", "m", 2, 0.25, {0.25, 3, 0.25, 0.25}}};
  return grid;
}

std::string textOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void writeText(const std::string& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

class FieldFormats : public ::testing::Test {
 protected:
  std::string write(const Grid& grid, const std::string& name) {
    StagedOutput output(folder_ / name, gridFormatFor(name), true);
    output.write(grid);
    output.commit();
    return folder_ / name;
  }
  // The message of reading the fort.14 with that fort.13; empty if none.
  std::string refusalOf(const std::string& fort13) {
    const std::string path = write(twoTriangles(), "a.14");
    writeText(folder_ / "a.13", fort13);
    try {
      readGrid(path);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }
  TemporaryFolder folder_;
};

void expectSameFields(const Grid& a, const Grid& b) {
  ASSERT_EQ(a.node_fields.size(), b.node_fields.size());
  for (const NodeField& field : a.node_fields) {
    const NodeField* const other = findField(b, field.name, field.component);
    ASSERT_NE(other, nullptr) << titleOf(field);
    EXPECT_EQ(other->unit, field.unit);
    EXPECT_EQ(other->values, field.values);
  }
}

// As ADCIRC's manual describes the file, line by line.
TEST_F(FieldFormats, Fort13ListsNodesThatAreNotUsual) {
  write(twoTriangles(), "fort.14");
  EXPECT_EQ(textOf(folder_ / "fort.13"),
            "two triangles\n4\n2\n"
            "mannings_n_at_sea_floor\ns/m^(1/3)\n1\n0.02\n"
            "two_values\nm\n2\n0.5 0.25\n"
            "mannings_n_at_sea_floor\n2\n2 0.1\n4 0.025\n"
            "two_values\n2\n2 0.5 3\n3 7 0.25\n");
}

TEST_F(FieldFormats, Fort13IsReadBackAsTheSameBytes) {
  const Grid grid = twoTriangles();
  const Grid read = readGrid(write(grid, "a.14"));
  expectSameFields(grid, read);
  EXPECT_THAT(read.notes, IsEmpty());
  write(read, "b.14");
  EXPECT_EQ(textOf(folder_ / "a.13"), textOf(folder_ / "b.13"));
}

TEST_F(FieldFormats, AGridWithoutFieldsHasNoFort13AndReplacesAnOldOne) {
  write(twoTriangles(), "a.14");
  Grid plain = twoTriangles();
  plain.node_fields.clear();
  write(plain, "a.14");
  EXPECT_THAT(folder_.names(), ElementsAre("a.14"));
  writeText(folder_ / "b.13", "of another program");
  EXPECT_THROW(StagedOutput(folder_ / "b.14", gridFormatFor("b.14"), false), OutputError);
}

// Fortran's list-directed input, and nodes numbered in any order.
TEST_F(FieldFormats, Fort13OfOtherPrograms) {
  writeText(folder_ / "a.14", "title\n1 3\n30 0 0 1\n10 100 0 2\n20 0 100 3\n1 3 30 10 20\n0\n0\n0\n0\n");
  writeText(folder_ / "a.13",
            "any\r\n 3 ! nodes\r\n2\r\n  a name with blanks \r\n\r\n1\r\n 1.5D-2\r\n"
            "condensed_nodes\r\nnone\r\n2\r\n0 0\r\n"
            "condensed_nodes\r\n1\r\n10 20 30\r\na name with blanks\r\n2\r\n20 0.5\r\n30\r\n7\r\n");
  const Grid grid = readGrid(folder_ / "a.14");
  ASSERT_THAT(grid.node_fields, SizeIs(1));
  EXPECT_EQ(grid.node_fields[0].name, "a name with blanks");
  EXPECT_EQ(grid.node_fields[0].unit, "");
  EXPECT_EQ(grid.node_fields[0].usual, 0.015);
  EXPECT_THAT(grid.node_fields[0].values, ElementsAre(7, 0.015, 0.5));
  EXPECT_THAT(grid.notes.back(), HasSubstr("condensed_nodes"));
}

TEST_F(FieldFormats, DamagedFort13IsRefusedWithItsPlace) {
  const std::string start = "t\n4\n1\nmanning\n1\n1\n0.02\n";
  EXPECT_THAT(refusalOf("t\n5\n0\n"), HasSubstr("attributes of 5 nodes, but the mesh beside it has 4"));
  EXPECT_THAT(refusalOf(start + "other\n0\n"), HasSubstr("the attribute other is not among those"));
  EXPECT_THAT(refusalOf(start + "manning\n1\n5 0.1\n"), HasSubstr("line 10: there is no node 5"));
  EXPECT_THAT(refusalOf(start + "manning\n1\n4 x\n"), HasSubstr("line 10"));
  EXPECT_THAT(refusalOf(start + "manning\n1\n"), HasSubstr("a.13"));
  EXPECT_THAT(refusalOf(start), HasSubstr("a.13"));
  EXPECT_THAT(refusalOf("t\n4\n1\nmanning\n1\n0\n"), HasSubstr("manning has 0 values"));
  EXPECT_THAT(refusalOf("t\n4\n2\nm\n1\n1\n1\nm\n1\n1\n1\nm\n0\nm\n0\n"), HasSubstr("m is there twice"));
  EXPECT_THAT(refusalOf("t\n4\n2\nm\n1\n1\n1\nn\n1\n1\n1\nm\n0\nm\n0\n"), HasSubstr("m has values twice"));
}

TEST_F(FieldFormats, ModelsNeedAllValues) {
  Grid grid = twoTriangles();
  grid.node_fields[0].values[2] = kUnknown;
  for (const char* const name : {"a.14", "a.gr3", "a.slf"}) {
    try {
      write(grid, name);
      ADD_FAILURE() << name;
    } catch (const OutputError& error) {
      EXPECT_THAT(error.what(), HasSubstr("mannings_n_at_sea_floor is not known at node 3 at (100, 100)"));
      EXPECT_THAT(error.what(), HasSubstr("--attribute manning="));
    }
  }
  EXPECT_THAT(folder_.names(), IsEmpty());
}

TEST_F(FieldFormats, SchismHasAFileOfEach) {
  write(twoTriangles(), "hgrid.gr3");
  const std::string manning = textOf(folder_ / "manning.gr3");
  EXPECT_EQ(manning,
            "two triangles\n2 4\n1 0 0 0.02\n2 100 0 0.1\n3 100 100 0.02\n4 0 100 0.025\n1 3 1 2 3\n2 3 1 3 4\n");
  EXPECT_THAT(folder_.names(), ElementsAre("hgrid.gr3", "manning.gr3", "two_values_1.gr3", "two_values_2.gr3"));
  const Grid read = readGrid(folder_ / "hgrid.gr3");
  ASSERT_THAT(read.node_fields, SizeIs(1));
  EXPECT_EQ(read.node_fields[0].name, "mannings_n_at_sea_floor");
  EXPECT_THAT(read.node_fields[0].values, ElementsAre(0.02, 0.1, 0.02, 0.025));
}

TEST_F(FieldFormats, SchismsFilesOfAMeshOfAnotherNameHaveThat) {
  const std::string path = write(twoTriangles(), "lake.gr3");
  EXPECT_THAT(folder_.names(),
              ElementsAre("lake.gr3", "lake_manning.gr3", "lake_two_values_1.gr3", "lake_two_values_2.gr3"));
  EXPECT_THAT(readGrid(path).node_fields, SizeIs(1));
  writeText(folder_ / "lake_manning.gr3", "t\n1 3\n1 0 0 1\n2 1 0 1\n3 0 1 1\n1 3 1 2 3\n");
  EXPECT_THROW(readGrid(path), InputError);
}

TEST_F(FieldFormats, SchismsValuesMayEndAfterTheNodes) {
  const std::string path = write(twoTriangles(), "hgrid.gr3");
  const std::string manning = folder_ / "manning.gr3";
  writeText(manning, "\n2 4\n1 0 0 0.02\n2 100 0 0\n3 100 100 -0.5\n4 0 100 0.025");
  EXPECT_THAT(readGrid(path).node_fields[0].values, ElementsAre(0.02, 0.0, -0.5, 0.025));
  const auto refusal = [&](const std::string& text) -> std::string {
    writeText(manning, text);
    try {
      readGrid(path);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_THAT(refusal("t\n1 4\n"), HasSubstr("has 1 element and 4 nodes, but the mesh beside it has 2 and 4"));
  EXPECT_THAT(refusal("t\n2 4\n1 0 0 1\n2 0 0 1\n3 0 0 x\n"), HasSubstr("line 5"));
  EXPECT_THAT(refusal("t\n2 4\n1 0 0 1\n2 0 0 1\n3 0 0 1\n"), HasSubstr("ends too early"));
}

// The records of a SELAFIN file, each with its length before and after it.
std::vector<std::string> recordsOf(const std::string& bytes) {
  const auto lengthAt = [&](std::size_t at) {
    std::size_t length = 0;
    for (std::size_t k = 0; k < 4; ++k) length = 256 * length + static_cast<unsigned char>(bytes.at(at + k));
    return length;
  };
  std::vector<std::string> records;
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t length = lengthAt(at);
    records.push_back(bytes.substr(at + 4, length));
    EXPECT_EQ(lengthAt(at + 4 + length), length);
    at += 8 + length;
  }
  return records;
}

double doubleAt(const std::string& record, std::size_t i) {
  std::string bytes = record.substr(8 * i, 8);
  std::reverse(bytes.begin(), bytes.end());
  double value = 0.0;
  std::memcpy(&value, bytes.data(), sizeof value);
  return value;
}

TEST_F(FieldFormats, TelemacHasAVariableOfEach) {
  Grid grid = twoTriangles();
  grid.node_fields.push_back({"bottom_roughness_length", "m", 0, kUnknown, {1, 2, 3, 4}});
  const std::string path = write(grid, "a.slf");
  const std::vector<std::string> records = recordsOf(textOf(path));
  EXPECT_EQ(records[1], std::string("\0\0\0\5\0\0\0\0", 8));
  EXPECT_EQ(records[2], "BOTTOM          M               ");
  EXPECT_EQ(records[3], "BOTTOM FRICTION s/m^(1/3)       ");
  EXPECT_EQ(records[4], "TWO VALUES 1    m               ");
  EXPECT_EQ(records[6], "ROUGH           m               ");  // a second friction
  const std::string& friction = records[records.size() - 4];
  ASSERT_EQ(friction.size(), 32u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(doubleAt(friction, i), grid.node_fields[0].values[i]);
  const Grid read = readGrid(path);
  EXPECT_EQ(read.z, grid.z);
  ASSERT_NE(findField(read, "mannings_n_at_sea_floor"), nullptr);
  EXPECT_EQ(findField(read, "mannings_n_at_sea_floor")->values, grid.node_fields[0].values);
}

TEST_F(FieldFormats, UgridAndLayersKeepThem) {
  Grid grid = twoTriangles();
  grid.node_fields[0].values[3] = kUnknown;
  grid.node_fields[1].values[0] = -999.0;  // the fill value
  const Grid read = readGrid(write(grid, "a.nc"));
  ASSERT_THAT(read.node_fields, SizeIs(3));
  EXPECT_EQ(read.node_fields[0].name, "mannings_n_at_sea_floor");
  EXPECT_TRUE(std::isnan(read.node_fields[0].values[3]));
  EXPECT_EQ(read.node_fields[0].values[1], 0.1);
  EXPECT_EQ(read.node_fields[1].usual, 0.5);
  EXPECT_EQ(read.node_fields[2].component, 2u);
  EXPECT_NEAR(read.node_fields[1].values[0], -999.0, 1e-9);
  EXPECT_EQ(read.node_fields[2].values, grid.node_fields[2].values);
  EXPECT_EQ(read.z, grid.z);
  grid.node_fields[0].values[3] = 0.025;
  for (const char* const name : {"a.gpkg", "a.fgb", "a.shp", "a.geojson", "a.vtu"}) {
    const Grid layers = readGrid(write(grid, name));
    const NodeField* const manning = findField(layers, "mannings_n_at_sea_floor");
    ASSERT_NE(manning, nullptr) << name;
    EXPECT_EQ(manning->values, grid.node_fields[0].values) << name;
  }
}

// An attribute with a name that depths have is none.
TEST_F(FieldFormats, AttributesAreNoDepths) {
  Grid grid = twoTriangles();
  grid.z.clear();
  grid.node_fields = {{"sea_surface_height_above_geoid", "m", 0, 0.0, {1, 2, 3, 4}},
                      {"bathymetry", "m", 0, 0.0, {1, 2, 3, 4}}};
  const Grid read = readGrid(write(grid, "a.nc"));
  EXPECT_THAT(read.z, IsEmpty());
  EXPECT_THAT(read.node_fields, SizeIs(2));
}

TEST_F(FieldFormats, WhatCannotHoldThemSaysSo) {
  const Grid grid = twoTriangles();
  EXPECT_THAT(lossesIn(grid, gridFormatFor("a.2dm"), LossesOf::Input),
              HasSubstr("the nodal attributes mannings_n_at_sea_floor, two_values"));
  for (const char* const name : {"a.14", "a.gr3", "a.slf", "a.nc"})
    EXPECT_EQ(lossesIn(grid, gridFormatFor(name), LossesOf::Input), "") << name;
}

}  // namespace
}  // namespace coastmesh
