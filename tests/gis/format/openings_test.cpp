// What models call open boundaries and rivers, beside the files of the grid.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gis/format/grid_io.hpp"
#include "tests/gis/check/target_samples.hpp"

namespace coastmesh {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::StartsWith;

// The sides of a parallelogram; its south-western corner is the first node of TELEMAC's boundary.
constexpr double kNorth = 8 * 866.0;

Grid sea(const std::function<BoundaryKind(const Point& from, const Point& to)>& kind_of) {
  Grid grid = testing::soundGrid();
  grid.boundaries = cutLoops(grid, boundaryLoops(grid), [&](std::uint32_t from, std::uint32_t to) {
    return kind_of(grid.nodes[from], grid.nodes[to]);
  });
  return grid;
}

BoundaryKind named(BoundaryRole role, const std::string& name) { return {.role = role, .name = name}; }

// Open in the west; a river in the middle of the north, and one that ends in the south-east.
BoundaryKind westAndTwoRivers(const Point& from, const Point& to) {
  if (from.y == kNorth && to.y == kNorth)
    return from.x < 1000.0 && to.x > -2000.0 ? named(BoundaryRole::River, "Camú") : BoundaryKind{};
  if (from.y == 0.0 && to.y == 0.0)
    return to.x > 5000.0 && to.x < 8000.0 ? named(BoundaryRole::River, "Yuna") : BoundaryKind{};
  return from.x < 0.0 || to.x < 0.0 ? BoundaryKind{BoundaryRole::Open} : BoundaryKind{};
}

std::string openings(const Grid& grid, const std::string& path) { return openingsIn(grid, path, gridFormatFor(path)); }

std::vector<std::string> namesIn(const std::string& text) {
  std::vector<std::string> names;
  for (const char* const name : {"1 open", "2 open", "3 open", "1 'Yuna'", "2 'Yuna'", "2 'Camú'", "3 'Camú'"})
    if (text.find(name) != std::string::npos) names.push_back(name);
  return names;
}

TEST(Openings, TelemacsAreInTheOrderOfItsBoundary) {
  // The boundary starts with a shore in the south; that in the west ends there.
  EXPECT_THAT(namesIn(openings(sea(westAndTwoRivers), "sea.slf")),
              ::testing::ElementsAre("3 open", "1 'Yuna'", "2 'Camú'"));
  // It starts within the open boundary, which is the first then.
  const Grid southwest = sea([](const Point& from, const Point& to) {
    const bool at_start = from.y == 0.0 && to.y == 0.0 && to.x <= 2000.0;
    return at_start ? BoundaryKind{BoundaryRole::Open} : westAndTwoRivers(from, to);
  });
  const std::string text = openings(southwest, "sea.slf");
  EXPECT_THAT(text, StartsWith("liquid boundaries of 'sea.cli', in TELEMAC's order: 1 open near"));
  EXPECT_THAT(namesIn(text), ::testing::ElementsAre("1 open", "2 'Yuna'", "3 'Camú'"));
}

TEST(Openings, OneNeedsNoNumber) {
  const Grid grid = testing::openGrid();
  for (const char* const path : {"sea.slf", "sea_grd.dat", "sea.mesh", "fort.14", "sea.nc"})
    EXPECT_THAT(openings(grid, path), IsEmpty()) << path;
}

TEST(Openings, RiversOfFvcomAreNodes) {
  const Grid grid = sea(westAndTwoRivers);
  const std::string text = openings(grid, "sea_grd.dat");
  std::size_t rivers = 0;
  for (const Boundary& boundary : grid.boundaries) {
    if (boundary.role != BoundaryRole::River) continue;
    ++rivers;
    const std::uint32_t node = boundary.nodes[boundary.nodes.size() / 2];
    EXPECT_THAT(text, HasSubstr("'" + boundary.name + "': " + std::to_string(node + 1) + " near"));
  }
  EXPECT_EQ(rivers, 2u);
  EXPECT_THAT(text, Not(HasSubstr("open")));
}

}  // namespace
}  // namespace coastmesh
