// What files tell of the land of flood plains.
#include "gis/fields/plain_field.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "gis/error.hpp"
#include "gis/fields/fort13.hpp"
#include "gis/fields/node_fields.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

Grid fourNodes() {
  Grid grid;
  grid.nodes = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  grid.triangles = {{0, 1, 2}, {0, 2, 3}};
  return grid;
}

std::string textOf(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

TEST(PlainField, TellsLandFromWater) {
  Grid grid = fourNodes();
  EXPECT_FALSE(hasPlain(grid));
  EXPECT_THAT(landNodes(grid), IsEmpty());
  markPlain(grid, {0, 1, 1, 0});
  EXPECT_TRUE(hasPlain(grid));
  EXPECT_THAT(landNodes(grid), ElementsAre(0, 1, 1, 0));
  const NodeField* const field = findField(grid, "flood_plain");
  ASSERT_NE(field, nullptr);
  EXPECT_THAT(field->values, ElementsAre(0, 1, 1, 0));
  EXPECT_EQ(defaultOf(*field), 0.0);
  // Interpolated values, until they are rounded.
  findField(grid, "flood_plain")->values = {0.49, 0.5, 1, 0};
  EXPECT_THAT(landNodes(grid), ElementsAre(0, 1, 1, 0));
  markPlain(grid, {1, 0, 0, 0});
  EXPECT_THAT(landNodes(grid), ElementsAre(1, 0, 0, 0));
  EXPECT_EQ(grid.node_fields.size(), 1u);
}

// Without the attribute, what starts dry below the water is land too.
TEST(PlainField, KnowsWhatStartsDry) {
  Grid grid = fourNodes();
  grid.node_fields.push_back({"surface_submergence_state", "1", 0, 0.0, {0, 0, 1, 1}});
  EXPECT_FALSE(hasPlain(grid));
  EXPECT_THAT(landNodes(grid), ElementsAre(0, 0, 1, 1));
  markPlain(grid, {0, 1, 0, 0});
  EXPECT_THAT(landNodes(grid), ElementsAre(0, 1, 0, 0));
}

// ADCIRC reads as many attributes as the file counts.
TEST(PlainField, StandsBehindTheAttributesOfAdcirc) {
  const testing::TemporaryFolder folder;
  for (const bool others : {false, true}) {
    Grid grid = fourNodes();
    markPlain(grid, {0, 1, 0, 0});
    if (others) grid.node_fields.push_back({"surface_submergence_state", "1", 0, 0.0, {0, 0, 0, 1}});
    const std::string path = folder / "fort.13";
    writeFort13(path, grid, inOrder);
    const std::string known =
        others ? "1\nsurface_submergence_state\n1\n1\n0\nsurface_submergence_state\n1\n4 1\n" : "0\n";
    EXPECT_EQ(textOf(path), "coastmesh\n4\n" + known + "flood_plain\n1\n1\n0\nflood_plain\n1\n2 1\n");
    Grid read = fourNodes();
    readFort13(path, {1, 2, 3, 4}, read);
    ASSERT_EQ(read.node_fields.size(), others ? 2u : 1u);
    EXPECT_THAT(landNodes(read), ElementsAre(0, 1, 0, 0));
    EXPECT_EQ(findField(read, "surface_submergence_state") != nullptr, others);
  }
  // Other programs' files may have it as any other attribute, but not twice.
  const std::string twice = folder / "twice.13";
  const std::string once = "flood_plain\n1\n1\n0\nflood_plain\n1\n2 1\n";
  std::ofstream(twice) << "x\n4\n1\n" << once << once;
  Grid read = fourNodes();
  EXPECT_THAT(
      [&] {
        readFort13(twice, {1, 2, 3, 4}, read);
      },
      ::testing::ThrowsMessage<InputError>(::testing::HasSubstr("the attribute flood_plain is there twice")));
}

}  // namespace
}  // namespace coastmesh
