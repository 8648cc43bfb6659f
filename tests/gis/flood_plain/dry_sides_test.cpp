// Open boundaries across dry land.
#include "gis/flood_plain/dry_sides.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <tuple>

#include "core/metric.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using testing::lattice;

// A square of ten by ten squares of one metre. `south`: the heights of the nodes along y = 0, from west to east; all
// others are 5 m below the water. The boundary is open in the south alone, or all around.
Grid squareOf(const std::vector<double>& south, bool open_all_around = false) {
  const TriMesh mesh = lattice(10, 10, [](int, int) { return true; });
  Grid grid;
  grid.nodes = mesh.points;
  for (const Triangle& t : mesh.triangles) grid.triangles.push_back(t.v);
  for (const Point& node : grid.nodes) grid.z.push_back(node.y > 0.0 ? -5.0 : south[static_cast<std::size_t>(node.x)]);
  grid.boundaries = findBoundaries(mesh);
  if (open_all_around) {
    grid.boundaries.front().role = BoundaryRole::Open;
    return grid;
  }
  Boundary open{BoundaryRole::Open, false, {}}, shore{BoundaryRole::Land, false, {}};
  for (std::uint32_t i = 0; i <= 10; ++i) open.nodes.push_back(i);
  const std::vector<std::uint32_t> all = grid.boundaries.front().nodes;
  const auto from = static_cast<std::size_t>(std::ranges::find(all, 10u) - all.begin());
  for (std::size_t k = 0; k <= 30; ++k) shore.nodes.push_back(all[(from + k) % all.size()]);
  EXPECT_EQ(shore.nodes.back(), 0u);
  grid.boundaries = {open, shore};
  return grid;
}

// The first nodes of the open edges along y = 0, which are numbered by their x.
std::set<std::uint32_t> openInTheSouth(const Grid& grid) {
  std::set<std::uint32_t> open;
  for (const Boundary& boundary : grid.boundaries)
    if (boundary.role == BoundaryRole::Open)
      for (const auto& [from, to] : edgesOf(boundary))
        if (from <= 10 && to <= 10) open.insert(from);
  return open;
}

constexpr double kWet = -2.0, kDry = 3.0, kUnknown = std::numeric_limits<double>::quiet_NaN();
using Edges = std::set<std::uint32_t>;
const Edges kAll{0, 1, 2, 3, 4, 5, 6, 7, 8, 9};

TEST(DrySides, WaterStaysOpen) {
  Grid grid = squareOf({kWet, kWet, kUnknown, kWet, kWet, kWet, kWet, kWet, kWet, kWet, kWet});
  EXPECT_EQ(closeDrySides(grid, false).edges, 0u);
  EXPECT_EQ(openInTheSouth(grid), kAll);
}

TEST(DrySides, ALongStretchBetweenWatersBecomesLand) {
  Grid grid = squareOf({kWet, kWet, kWet, kDry, 0.0, kDry, kWet, kWet, kWet, kWet, kWet});
  const DrySides dry = closeDrySides(grid, false);
  EXPECT_EQ(openInTheSouth(grid), (Edges{0, 1, 6, 7, 8, 9}));
  EXPECT_EQ(dry.edges, 4u);
  EXPECT_DOUBLE_EQ(dry.length_m, 4.0);
  EXPECT_EQ(dry.place, (Point{2.5, 0.0}));
}

TEST(DrySides, AShortBarStaysOpen) {
  Grid grid = squareOf({kWet, kWet, kWet, kDry, kDry, kWet, kWet, kWet, kWet, kWet, kWet});
  EXPECT_EQ(closeDrySides(grid, true).edges, 0u);
  EXPECT_EQ(openInTheSouth(grid), kAll);
}

TEST(DrySides, StretchesAtTheCoastBecomeLand) {
  const std::vector<double> south{kDry, kDry, kWet, kWet, kWet, kWet, kWet, kWet, kWet, kWet, kDry};
  Grid grid = squareOf(south);
  closeDrySides(grid, false);
  EXPECT_EQ(openInTheSouth(grid), (Edges{2, 3, 4, 5, 6, 7, 8, 9}));  // a single node may be lowered
  grid = squareOf(south);
  closeDrySides(grid, true);
  EXPECT_EQ(openInTheSouth(grid), (Edges{2, 3, 4, 5, 6, 7, 8}));
}

// Flags of land on the squares from `first` to `last` along y = 0, counted by their west sides.
LandFlags landOnSquares(const Grid& grid, double first, double last) {
  LandFlags land;
  land.nodes.assign(grid.nodes.size(), 1);
  for (const auto& corners : grid.triangles) {
    Point middle;
    for (const std::uint32_t corner : corners) middle = middle + (1.0 / 3.0) * grid.nodes[corner];
    land.triangles.push_back(middle.y < 1.0 && middle.x > first && middle.x < last + 1.0);
    if (land.triangles.back() == 0)
      for (const std::uint32_t corner : corners) land.nodes[corner] = 0;
  }
  return land;
}

TEST(DrySides, LandOfAFloodPlainIsLandBelowTheWaterToo) {
  const std::vector<double> south(11, kWet);
  for (const auto& [first, last, open] :
       {std::tuple{3.0, 6.0, Edges{0, 1, 2, 7, 8, 9}}, std::tuple{0.0, 3.0, Edges{4, 5, 6, 7, 8, 9}},
        std::tuple{4.0, 4.0, Edges{0, 1, 2, 3, 5, 6, 7, 8, 9}},  // a narrow bar
        std::tuple{0.0, 9.0, Edges{}}}) {
    Grid grid = squareOf(south);
    const DrySides dry = closeDrySides(grid, true, landOnSquares(grid, first, last));
    EXPECT_EQ(openInTheSouth(grid), open) << first;
    EXPECT_EQ(dry.edges, 10u - open.size());
  }
}

TEST(DrySides, ADikeInFrontOfAPolderIsNotBreached) {
  const std::vector<double> south{kWet, kWet, kWet, kDry, kWet, kWet, kWet, kWet, kWet, kWet, kWet};
  Grid grid = squareOf(south);
  closeDrySides(grid, true);
  EXPECT_EQ(openInTheSouth(grid), kAll);  // as if both sides were water
  grid = squareOf(south);
  closeDrySides(grid, true, landOnSquares(grid, 3.0, 9.0));
  EXPECT_EQ(openInTheSouth(grid), (Edges{0, 1}));
  grid = squareOf(south);
  closeDrySides(grid, false, landOnSquares(grid, 3.0, 9.0));
  EXPECT_EQ(openInTheSouth(grid), (Edges{0, 1, 2}));
}

TEST(DrySides, AllAroundTheMesh) {
  Grid grid = squareOf({kDry, kDry, kDry, kWet, kWet, kWet, kWet, kWet, kWet, kWet, kWet}, true);
  closeDrySides(grid, false);
  EXPECT_EQ(openInTheSouth(grid), (Edges{3, 4, 5, 6, 7, 8, 9}));
  std::size_t open = 0, land = 0;
  for (const Boundary& boundary : grid.boundaries)
    (boundary.role == BoundaryRole::Open ? open : land) += edgesOf(boundary).size();
  EXPECT_EQ(open, 36u);
  EXPECT_EQ(land, 4u);  // three in the south, and that from the corner to the north
  for (double& z : grid.z) z = kDry;
  closeDrySides(grid, false);
  EXPECT_TRUE(openInTheSouth(grid).empty());
  ASSERT_EQ(grid.boundaries.size(), 1u);
  EXPECT_EQ(grid.boundaries.front().role, BoundaryRole::Land);
}

}  // namespace
}  // namespace coastmesh
