#include "gis/solver/vertical_levels.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>

#include "gis/elements/elements.hpp"
#include "gis/elements/quads.hpp"
#include "gis/error.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class VerticalLevelsOfFiles : public ::testing::Test {
 protected:
  VerticalLevels read(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return readVerticalLevels(folder_ / name);
  }
  std::string errorOf(const std::string& name, const std::string& text) const {
    try {
      read(name, text);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  }

  coastmesh::testing::TemporaryFolder folder_;
};

// Two triangles side by side.
Grid strip(const std::vector<double>& depths) {
  Grid grid;
  grid.nodes = {{0, 0}, {1, 0}, {0, 1}, {1, 1}};
  grid.triangles = {{0, 1, 2}, {1, 3, 2}};
  for (const double depth : depths) grid.z.push_back(-depth);
  return grid;
}

std::vector<double> elementLayers(const Grid& grid, const VerticalLevels& levels) {
  return layersOfElements(grid, Elements(grid), levels);
}

std::vector<double> nodeLayers(const Grid& grid, const VerticalLevels& levels) {
  return layersOfNodes(grid, Elements(grid), levels);
}

// Middles of layers are at 5, 15, 25, 40, 60, 85, 150 m. The bottom of an element is the last level with a middle above
// the mean depth, at least the fifth level.
constexpr const char* kAux3d = "8\n0\n-10 -20\n-30\n-50\n-70 -100 -200\n-12\n-95\n-95\n-95\n";

TEST_F(VerticalLevelsOfFiles, OfFesom2FollowMeanDepthsOfElements) {
  const VerticalLevels levels = read("aux3d.out", kAux3d);
  EXPECT_THAT(std::get<FesomLevels>(levels.levels).depths_m, ElementsAre(0, 10, 20, 30, 50, 70, 100, 200));
  // Mean depths 64 and 95 m.
  const Grid grid = strip({2, 95, 95, 95});
  EXPECT_THAT(elementLayers(grid, levels), ElementsAre(5, 6));
  EXPECT_THAT(nodeLayers(grid, levels), ElementsAre(5, 6, 6, 6));
  // A middle itself counts as reached.
  EXPECT_THAT(elementLayers(strip({60, 60, 60, 60}), levels), ElementsAre(5, 5));
  EXPECT_THAT(elementLayers(strip({59.9, 59.9, 59.9, 59.9}), levels), ElementsAre(4, 4));
  // At least four layers, at most all.
  EXPECT_THAT(elementLayers(strip({1, 1, 1, 1}), levels), ElementsAre(4, 4));
  EXPECT_THAT(elementLayers(strip({-3, -3, 9000, 9000}), levels), ElementsAre(7, 7));
  EXPECT_THAT(elementLayers(strip({}), levels), ElementsAre(4, 4));
}

TEST_F(VerticalLevelsOfFiles, PositiveLevelsAreTheSame) {
  const VerticalLevels levels = read("aux3d.out", "3\n0\n10\n20\n5\n5\n5\n5\n");
  EXPECT_THAT(std::get<FesomLevels>(levels.levels).depths_m, ElementsAre(0, 10, 20));
}

constexpr const char* kSz =
    "2 !ivcor\n7 3 100. !nvrt, kz, h_s\nZ levels\n1 -5000.\n2 -1000.\n3 -100.\nS levels\n"
    "40. 1. 1.e-4\n3 -1.\n4 -0.7\n5 -0.4\n6 -0.1\n7 0.\n";

// Four S layers, and Z layers down to 1000 m and to 5000 m.
TEST_F(VerticalLevelsOfFiles, OfSchismsSzFollowTheShallowestNode) {
  const VerticalLevels levels = read("vgrid.in", kSz);
  const Grid grid = strip({0.0, 50.0, 100.0, 100.5});
  EXPECT_THAT(nodeLayers(grid, levels), ElementsAre(1, 4, 4, 5));
  EXPECT_THAT(elementLayers(grid, levels), ElementsAre(1, 4));
  const Grid deep = strip({1000.0, 1000.5, 5000.0, 8000.0});
  EXPECT_THAT(nodeLayers(deep, levels), ElementsAre(5, 6, 6, 7));
  EXPECT_THAT(elementLayers(deep, levels), ElementsAre(5, 6));
}

TEST_F(VerticalLevelsOfFiles, OfSchismsLsc2AreThoseOfNodes) {
  const VerticalLevels levels = read("vgrid.in", "1 !ivcor\n21\n  21 20 11 1\n1 -9. -1. -1. -1.\n");
  const Grid grid = strip({});
  EXPECT_THAT(nodeLayers(grid, levels), ElementsAre(1, 1, 10, 20));
  EXPECT_THAT(elementLayers(grid, levels), ElementsAre(10, 20));
  Grid larger = strip({});
  larger.nodes.push_back({5, 5});
  try {
    nodeLayers(larger, levels);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("vgrid.in' has the levels of 4 nodes, and the mesh has 5"));
  }
}

// A line for each node, as before October 2021; Fortran reads on in the next line.
TEST_F(VerticalLevelsOfFiles, OfSchismsOlderLsc2AreTheSame) {
  const VerticalLevels levels = read("vgrid.in",
                                     "1 !ivcor\n5\n 1 5 0.\n 2 3 -1.000000 -0.5\n 0.000000\n"
                                     " 3 1 -1 -0.8 -0.6 -0.2 0\n\n 4 2 -1. -0.7 -0.2 0.\n");
  EXPECT_THAT(nodeLayers(strip({}), levels), ElementsAre(1, 2, 4, 3));
}

TEST_F(VerticalLevelsOfFiles, AQuadrilateralIsOneElement) {
  Grid grid;
  grid.nodes = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  addElement(grid, std::array<std::uint32_t, 4>{0, 1, 2, 3});
  grid.z = {-60, -60, -60, -100};
  EXPECT_THAT(elementLayers(grid, read("aux3d.out", kAux3d)), ElementsAre(5));
  EXPECT_THAT(elementLayers(grid, read("vgrid.in", kSz)), ElementsAre(4));
}

TEST_F(VerticalLevelsOfFiles, AnUnknownDepthIsNamed) {
  try {
    elementLayers(strip({1, 1, std::numeric_limits<double>::quiet_NaN(), 1}), read("aux3d.out", kAux3d));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("node 3 at (0, 1) has no depth"));
  }
}

TEST_F(VerticalLevelsOfFiles, BadFilesAreRefusedWithTheirLine) {
  EXPECT_THAT(errorOf("aux3d.out", "1\n0\n"), HasSubstr("line 1: the number of levels is expected"));
  EXPECT_THAT(errorOf("aux3d.out", "3\n0\n-20\n-10\n"), HasSubstr("not in the order of their depths"));
  EXPECT_THAT(errorOf("aux3d.out", "4\n0\n-20\n"), HasSubstr("ends"));
  EXPECT_THAT(errorOf("vgrid.in", "3\n2\n"), HasSubstr("ivcor is expected"));
  EXPECT_THAT(errorOf("vgrid.in", "2\n3 3 100.\n"), HasSubstr("line 2: the number of levels and that of Z levels"));
  EXPECT_THAT(errorOf("vgrid.in", "1\n5\n3 6 1 1\n"), HasSubstr("line 3: there is no level 6"));
  EXPECT_THAT(errorOf("vgrid.in", "1\n5\n1 3 -1.000 -0.5 0.\n3 4 -1. 0.\n"),
              HasSubstr("line 4: the levels of node 2 are expected"));
  EXPECT_THAT(errorOf("vgrid.in", "1\n5\n1 6 -1.000 -0.5 0.\n"), HasSubstr("line 3: there is no level 6"));
  EXPECT_THAT(errorOf("vgrid.in", "1\n5\n1 3 -1.000 -0.5\n"), HasSubstr("ends"));
}

TEST(VerticalLevels, FilesAreKnownByTheirNames) {
  EXPECT_TRUE(isLevelFile("run/vgrid.in"));
  EXPECT_TRUE(isLevelFile("mesh/aux3d.out"));
  EXPECT_FALSE(isLevelFile("levels.csv"));
}

}  // namespace
}  // namespace coastmesh
