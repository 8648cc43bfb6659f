// Triangle fills whatever has no hole point.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gis/format/grid_io.hpp"
#include "gis/format/poly_io.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::Gt;
using ::testing::IsEmpty;
using ::testing::Lt;
using testing::TemporaryFolder;

std::vector<Point> holesOf(const Grid& grid) {
  const TemporaryFolder folder;
  StagedOutput output(folder / "lake.node", gridFormatFor("lake.node"), false);
  output.write(grid);
  output.commit();
  std::ifstream file(folder / "lake.poly");
  std::string line;
  std::size_t segments = 0, holes = 0;
  std::getline(file, line);
  file >> segments;
  std::getline(file, line);
  for (std::size_t i = 0; i < segments; ++i) std::getline(file, line);
  file >> holes;
  std::vector<Point> points(holes);
  std::size_t number = 0;
  for (Point& point : points) file >> number >> point.x >> point.y;
  EXPECT_FALSE(file.fail());
  return points;
}

Grid gridOf(const TriMesh& mesh) {
  Grid grid;
  grid.nodes = mesh.points;
  for (const Triangle& t : mesh.triangles) grid.triangles.push_back(t.v);
  grid.boundaries = findBoundaries(mesh);
  return grid;
}

auto inCell(double x, double y) {
  return AllOf(Field(&Point::x, AllOf(Gt(x), Lt(x + 1))), Field(&Point::y, AllOf(Gt(y), Lt(y + 1))));
}

// A river on an island, or an island of two types.
TEST(TriangleFiles, IslandsInPiecesAreHoles) {
  Grid grid = gridOf(testing::lattice(5, 5, [](int i, int j) { return i != 2 || j != 3; }));
  EXPECT_THAT(holesOf(grid), ElementsAre(inCell(2, 3)));
  const auto island = std::ranges::find(grid.boundaries, BoundaryRole::Island, &Boundary::role);
  ASSERT_NE(island, grid.boundaries.end());
  const std::vector<std::uint32_t> loop = island->nodes;
  *island = {BoundaryRole::River, false, {loop[0], loop[1]}};
  grid.boundaries.push_back({BoundaryRole::Land, false, {loop[1], loop[2], loop[3], loop[0]}});
  EXPECT_THAT(holesOf(grid), ElementsAre(inCell(2, 3)));
}

// Where they touch in a node, the mesh's boundary may pass it twice.
TEST(TriangleFiles, IslandsThatTouchAreTwoHoles) {
  const Grid grid =
      gridOf(testing::lattice(5, 5, [](int i, int j) { return (i != 1 || j != 1) && (i != 2 || j != 2); }));
  EXPECT_THAT(holesOf(grid), ::testing::UnorderedElementsAre(inCell(1, 1), inCell(2, 2)));
}

TEST(TriangleFiles, ACrackIsNoHole) {
  Grid grid = gridOf(testing::lattice(4, 4, [](int, int) { return true; }));
  // The nodes of a line inside get copies for the triangles above it.
  const auto at = [](std::uint32_t i, std::uint32_t j) { return 5 * j + i; };
  const auto copy = static_cast<std::uint32_t>(grid.nodes.size());
  grid.nodes.push_back(grid.nodes[at(2, 2)]);
  for (auto& corners : grid.triangles) {
    const bool above = std::ranges::all_of(corners, [&](std::uint32_t v) { return grid.nodes[v].y >= 2.0; });
    if (above) std::ranges::replace(corners, at(2, 2), copy);
  }
  EXPECT_THAT(holesOf(grid), IsEmpty());
}

}  // namespace
}  // namespace coastmesh
