// Formats that cannot hold weirs have both of their shores.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "gis/format/grid_io.hpp"
#include "gis/grid/boundary_kinds.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using ::testing::ElementsAre;
using testing::TemporaryFolder;

constexpr int kColumns = 5, kRows = 3;

std::uint32_t at(int i, int j) { return static_cast<std::uint32_t>(j * (kColumns + 1) + i); }

Grid gridOf(const TriMesh& mesh) {
  Grid grid;
  grid.crs = parseCrs("EPSG:4326");
  grid.nodes = mesh.points;
  for (const Triangle& t : mesh.triangles) grid.triangles.push_back(t.v);
  grid.z.assign(grid.nodes.size(), -5.0);
  return grid;
}

Point place(int i, int j) { return {8.0 + 0.1 * i, 54.0 + 0.1 * j}; }

// Two waters with a levee between them, from x = 2 to 3.
Grid leveeGrid(int ibtype) {
  Grid grid = gridOf(testing::lattice(
      kColumns, kRows, [](int i, int) { return i != 2; }, place));
  Boundary west{
      BoundaryRole::Land, false, {at(2, 3), at(1, 3), at(0, 3), at(0, 2), at(0, 1), at(0, 0), at(1, 0), at(2, 0)}};
  Boundary levee{BoundaryRole::Land, false, {at(2, 0), at(2, 1), at(2, 2), at(2, 3)}, ibtype};
  levee.back_nodes = {at(3, 0), at(3, 1), at(3, 2), at(3, 3)};
  levee.weir.assign(3 * levee.nodes.size(), 1.5);
  Boundary east{
      BoundaryRole::Land, false, {at(3, 0), at(4, 0), at(5, 0), at(5, 1), at(5, 2), at(5, 3), at(4, 3), at(3, 3)}};
  grid.boundaries = {west, levee, east};
  return grid;
}

Grid throughFile(const Grid& grid, const GridFormat& format) {
  const TemporaryFolder folder;
  const std::string path = folder / ("levee" + std::string(format.endings.front()));
  StagedOutput output(path, format, false);
  output.write(grid);
  output.commit();
  return readGrid(path, grid.crs);
}

std::vector<NodePair> sortedEdges(const std::vector<Boundary>& boundaries) {
  std::vector<NodePair> edges;
  for (const Boundary& boundary : boundaries)
    for (const NodePair& edge : edgesOf(boundary)) edges.push_back(edge);
  std::ranges::sort(edges);
  return edges;
}

std::vector<NodePair> sortedLoopEdges(const Grid& grid) {
  std::vector<Boundary> loops;
  for (const auto& nodes : boundaryLoops(grid)) loops.push_back({BoundaryRole::Land, true, nodes});
  return sortedEdges(loops);
}

class Levee : public ::testing::TestWithParam<GridFormat> {};

TEST_P(Levee, HasBothItsShores) {
  const GridFormat& format = GetParam();
  const Grid grid = leveeGrid(24), got = throughFile(grid, format);
  if (format.holds.has(GridPart::Weirs)) {
    ASSERT_EQ(got.boundaries.size(), grid.boundaries.size());
    EXPECT_EQ(got.boundaries[1].back_nodes, grid.boundaries[1].back_nodes);
    return;
  }
  EXPECT_EQ(sortedEdges(got.boundaries), sortedLoopEdges(got));
  for (const Boundary& boundary : got.boundaries) {
    EXPECT_EQ(boundary.role, BoundaryRole::Land);
    EXPECT_TRUE(boundary.back_nodes.empty());
  }
}

std::vector<GridFormat> formatsOfBoundaries() {
  std::vector<GridFormat> formats;
  for (const GridFormat& format : gridFormats())
    if (format.readable && format.writable && !format.beside_grid && !format.endings.empty()) formats.push_back(format);
  return formats;
}

INSTANTIATE_TEST_SUITE_P(Formats, Levee, ::testing::ValuesIn(formatsOfBoundaries()),
                         [](const auto& instance) { return "to_" + std::string(instance.param.name); });

TEST(WeirsAsShores, HaveTheMeshToTheirLeft) {
  const std::vector<Boundary> shores = weirsAsShores(leveeGrid(24));
  ASSERT_EQ(shores.size(), 4u);
  EXPECT_THAT(shores[1].nodes, ElementsAre(at(2, 0), at(2, 1), at(2, 2), at(2, 3)));
  EXPECT_THAT(shores[2].nodes, ElementsAre(at(3, 3), at(3, 2), at(3, 1), at(3, 0)));
  for (const Boundary& shore : shores) EXPECT_TRUE(shore.weir.empty() && shore.back_nodes.empty());
}

// Files may name the shore across as a boundary of its own.
TEST(WeirsAsShores, AreNotListedTwice) {
  Grid grid = leveeGrid(4);
  grid.boundaries.push_back({BoundaryRole::Land, false, {at(3, 3), at(3, 2), at(3, 1), at(3, 0)}});
  EXPECT_EQ(sortedEdges(weirsAsShores(grid)), sortedLoopEdges(grid));
}

// A levee around an area that lies in an island of the outer mesh.
TEST(WeirsAsShores, OfARingAreClosed) {
  Grid grid = gridOf(testing::lattice(
      3, 3, [](int i, int j) { return i != 1 || j != 1; }, place));
  const auto outer = [](int i, int j) { return static_cast<std::uint32_t>(4 * j + i); };
  const auto first = static_cast<std::uint32_t>(grid.nodes.size());
  for (const Point shift : {Point{0.02, 0.02}, Point{0.08, 0.02}, Point{0.08, 0.08}, Point{0.02, 0.08}})
    grid.nodes.push_back({place(1, 1).x + shift.x, place(1, 1).y + shift.y});
  grid.triangles.push_back({first, first + 1, first + 2});
  grid.triangles.push_back({first, first + 2, first + 3});
  Boundary levee{BoundaryRole::Land, false, {first, first + 1, first + 2, first + 3, first}, 24};
  levee.back_nodes = {outer(1, 1), outer(2, 1), outer(2, 2), outer(1, 2), outer(1, 1)};
  levee.weir.assign(3 * levee.nodes.size(), 1.5);
  grid.boundaries = {levee};
  const std::vector<Boundary> shores = weirsAsShores(grid);
  ASSERT_EQ(shores.size(), 2u);
  EXPECT_EQ(shores[0].role, BoundaryRole::Land);
  EXPECT_EQ(shores[1].role, BoundaryRole::Island);
  for (const Boundary& shore : shores) {
    EXPECT_TRUE(shore.closed);
    EXPECT_EQ(shore.nodes.size(), 4u);
  }
}

}  // namespace
}  // namespace coastmesh
