#include "apps/job/check_grid.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "apps/job/grid_pieces.hpp"
#include "core/quality.hpp"

namespace coastmesh {

namespace {

// Adds n by 1 squares of two triangles each, in degrees, with lower left corner (west, south).
void addStrip(Grid& grid, double west, double south, double side, std::uint32_t squares) {
  const auto base = static_cast<std::uint32_t>(grid.nodes.size());
  for (std::uint32_t i = 0; i <= squares; ++i) {
    grid.nodes.push_back({west + i * side, south});
    grid.nodes.push_back({west + i * side, south + side});
  }
  for (std::uint32_t i = 0; i < squares; ++i) {
    const std::uint32_t at = base + 2 * i;
    grid.triangles.push_back({at, at + 2, at + 3});
    grid.triangles.push_back({at, at + 3, at + 1});
  }
}

Grid twoStrips() {
  Grid grid;
  grid.crs = wgs84();
  addStrip(grid, 10.0, 0.0, 0.01, 3);
  addStrip(grid, -120.0, 0.0, 0.01, 2);
  return grid;
}

std::vector<DefectKind> kindsOf(const std::vector<GridDefect>& defects) {
  std::vector<DefectKind> kinds;
  for (const GridDefect& defect : defects) kinds.push_back(defect.kind);
  return kinds;
}

TEST(GridPieces, PiecesShareNoNodeAndHoldAllTriangles) {
  const auto pieces = connectedTriangles(twoStrips());
  ASSERT_EQ(pieces.size(), 2u);
  EXPECT_THAT(pieces[0], testing::ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(pieces[1], testing::ElementsAre(6, 7, 8, 9));
}

TEST(GridPieces, TrianglesThatTouchInANodeAreOnePiece) {
  Grid grid;
  grid.nodes = {{0, 0}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  grid.triangles = {{0, 1, 2}, {0, 3, 4}};
  EXPECT_EQ(connectedTriangles(grid).size(), 1u);
}

TEST(GridPieces, PiecesPointBackToTheGrid) {
  const Grid grid = twoStrips();
  const std::vector<GridPiece> pieces = splitGrid(grid);
  ASSERT_EQ(pieces.size(), 2u);
  for (const GridPiece& piece : pieces) {
    ASSERT_EQ(piece.nodes.size(), piece.mesh.points.size());
    for (std::size_t v = 0; v < piece.nodes.size(); ++v) {
      const Point back = piece.projection.inverse(piece.mesh.points[v]);
      EXPECT_NEAR(back.x, grid.nodes[piece.nodes[v]].x, 1e-9);
      EXPECT_NEAR(back.y, grid.nodes[piece.nodes[v]].y, 1e-9);
    }
    for (std::size_t t = 0; t < piece.triangles.size(); ++t) {
      for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(piece.nodes[piece.mesh.triangles[t].v[i]], grid.triangles[piece.triangles[t]][i]);
      }
    }
    // Near the equator degrees are equally long: half a square has the angles 45, 45 and 90.
    EXPECT_NEAR(measureQuality(piece.mesh, 0.0).min_angle_deg, 45.0, 0.5);
  }
}

TEST(CheckGrid, SoundGridHasNoDefect) {
  GridCheckOptions options;
  options.min_angle_deg = 44.0;
  options.max_angle_deg = 91.0;
  options.delaunay = true;
  options.pinches = true;
  EXPECT_TRUE(checkGrid(twoStrips(), options).defects.empty());
}

TEST(CheckGrid, TurnedTriangleIsFoundWithItsNumber) {
  Grid grid = twoStrips();
  std::swap(grid.triangles[7][1], grid.triangles[7][2]);
  const auto defects = checkGrid(grid, {}).defects;
  ASSERT_FALSE(defects.empty());
  const auto turned = std::ranges::find(defects, DefectKind::NotCounterClockwise, &GridDefect::kind);
  ASSERT_NE(turned, defects.end());
  EXPECT_EQ(turned->triangle, 7);
  EXPECT_NEAR(turned->place.x, -120.0, 0.1);
}

TEST(CheckGrid, EdgeOfThreeTrianglesIsFound) {
  Grid grid = twoStrips();
  grid.nodes.push_back({10.005, -0.01});
  const auto extra = static_cast<std::uint32_t>(grid.nodes.size() - 1);
  grid.triangles.push_back({extra, 2, 0});
  grid.nodes.push_back({10.005, -0.02});
  grid.triangles.push_back({extra + 1, 2, 0});
  EXPECT_THAT(kindsOf(checkGrid(grid, {}).defects), testing::Contains(DefectKind::BrokenTopology));
}

TEST(CheckGrid, PinchIsFoundOnlyWhereAskedFor) {
  Grid grid;
  grid.nodes = {{0, 0}, {1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  grid.triangles = {{0, 1, 2}, {0, 3, 4}};
  EXPECT_TRUE(checkGrid(grid, {}).defects.empty());
  GridCheckOptions options;
  options.pinches = true;
  EXPECT_THAT(kindsOf(checkGrid(grid, options).defects), testing::ElementsAre(DefectKind::PinchedVertex));
}

TEST(CheckGrid, BorderOfFeaturesIsNoDelaunayDefect) {
  Grid grid;
  grid.nodes = {{0, 0}, {4, 0}, {2, 0.5}, {2, -0.5}};
  grid.triangles = {{0, 1, 2}, {1, 0, 3}};
  GridCheckOptions options;
  options.delaunay = true;
  EXPECT_THAT(kindsOf(checkGrid(grid, options).defects), testing::ElementsAre(DefectKind::NotDelaunay));
  grid.features = {{1, "a", {}}, {2, "b", {}}};
  grid.feature_of = {0, 1};
  EXPECT_TRUE(checkGrid(grid, options).defects.empty());
}

}  // namespace

}  // namespace coastmesh
