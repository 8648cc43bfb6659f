// FVCOM's _spg.dat: nodal attributes at open boundaries.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "gis/error.hpp"
#include "gis/fields/node_fields.hpp"
#include "gis/format/grid_io.hpp"
#include "gis/format/grid_losses.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using ::testing::HasSubstr;

class FvcomSponge : public ::testing::Test {
 protected:
  static Grid lakes() { return coastmesh::testing::sampleGrid(Crs{}, {0.0, 0.0}, 10.0, 6); }
  static void give(Grid& grid, const char* name, double value) {
    grid.node_fields.push_back({name, {}, 0, 0.0, std::vector<double>(grid.nodes.size(), value)});
  }
  std::string path() const { return folder_ / "sea_grd.dat"; }
  void write(const Grid& grid) const {
    StagedOutput output(path(), gridFormatFor(path(), {}), true);
    output.write(grid);
    output.commit();
  }
  std::string sponge() const {
    std::ifstream file(folder_ / "sea_spg.dat");
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
  }
  coastmesh::testing::TemporaryFolder folder_;
};

TEST_F(FvcomSponge, IsThatOfOpenNodesAndReadBack) {
  Grid grid = lakes();
  give(grid, "sponge_radius", 25.0);
  give(grid, "sponge_coefficient", 0.001);
  const std::vector<std::uint32_t>& open = grid.boundaries.front().nodes;
  findField(grid, "sponge_radius")->values[open[2]] = 0.0;
  write(grid);
  std::string expected = "Sponge Node Number = " + std::to_string(open.size() - 1) + "\n";
  for (std::size_t i = 0; i < open.size(); ++i)
    if (i != 2) expected += std::to_string(open[i] + 1) + " 25 0.001\n";
  EXPECT_EQ(sponge(), expected);
  const Grid read = readGrid(path());
  EXPECT_EQ(findField(read, "sponge_radius")->values[open[0]], 25.0);
  EXPECT_EQ(findField(read, "sponge_radius")->values[open[2]], 0.0);
  EXPECT_EQ(findField(read, "sponge_coefficient")->values[open[1]], 0.001);
  EXPECT_THAT(openingsIn(grid, path(), gridFormatFor(path(), {})), HasSubstr(" times as wide as the longest edge"));
  EXPECT_THAT(lossesIn(grid, gridFormatFor(path(), {}), LossesOf::Grid), ::testing::Not(HasSubstr("sponge")));
}

TEST_F(FvcomSponge, IsEmptyWithoutOpeningsAndLeftOutWithoutAttributes) {
  Grid grid = lakes();
  write(grid);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "sea_spg.dat"));
  std::erase_if(grid.boundaries, [](const Boundary& boundary) { return boundary.role == BoundaryRole::Open; });
  write(grid);
  EXPECT_EQ(sponge(), "Sponge Node Number = 0\n");
  EXPECT_TRUE(readGrid(path()).node_fields.empty());
}

TEST_F(FvcomSponge, WhatIsMissingIsNamed) {
  Grid grid = lakes();
  give(grid, "sponge_radius", 25.0);
  const auto refused = [&](const std::string& why) {
    try {
      write(grid);
      FAIL() << why;
    } catch (const OutputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(why));
    }
  };
  refused("a sponge needs sponge_coefficient too");
  give(grid, "sponge_coefficient", std::numeric_limits<double>::quiet_NaN());
  refused("sponge_coefficient is unknown at node ");
  findField(grid, "sponge_radius")->values.assign(grid.nodes.size(), -1.0);
  refused("sponge_radius is negative at node ");
}

}  // namespace
}  // namespace coastmesh
