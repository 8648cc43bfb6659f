#include "apps/job/step_outcome.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>

namespace coastmesh {
namespace {

// A strip of unit squares in a plane, each of two triangles: land along its long sides, open at its ends.
Grid strip(std::uint32_t squares) {
  Grid grid;
  Boundary south{BoundaryRole::Land, false, {}}, north = south;
  for (std::uint32_t i = 0; i <= squares; ++i) {
    for (const double y : {0.0, 1.0}) grid.nodes.push_back({static_cast<double>(i), y});
    south.nodes.push_back(2 * i);
    north.nodes.push_back(2 * (squares - i) + 1);
    if (i == squares) break;
    grid.triangles.push_back({2 * i, 2 * i + 2, 2 * i + 1});
    grid.triangles.push_back({2 * i + 2, 2 * i + 3, 2 * i + 1});
  }
  grid.boundaries = {south, north, {BoundaryRole::Open, false, {1, 0}}};
  grid.boundaries.push_back({BoundaryRole::Open, false, {2 * squares, 2 * squares + 1}});
  return grid;
}

TEST(StepOutcome, CoastsFinerThanTheSizesAreNoted) {
  Grid grid = strip(10);
  SizeOptions sizes;
  sizes.size_m = 3.0;
  const auto notes = [&](double size_along_shores, std::size_t nodes) {
    grid.size_m.assign(grid.nodes.size(), 1.0);
    std::fill_n(grid.size_m.begin(), nodes, size_along_shores);
    return measureOutcome(grid, sizes, inOrder).notes;
  };
  EXPECT_EQ(notes(1.9, grid.nodes.size()).size(), 0u);
  EXPECT_EQ(notes(3.0, 4).size(), 0u);  // some edges are always shorter
  ASSERT_EQ(notes(3.0, 12).size(), 1u);
  EXPECT_NE(notes(3.0, 12).front().find(" 50 % of the edges at the shore"), std::string::npos);
  sizes.coast = CoastDetail::Follow;
  EXPECT_EQ(notes(3.0, 12).size(), 0u);
  sizes = {};  // the sizes of a mesh that is only measured
  EXPECT_EQ(notes(3.0, 12).size(), 0u);
}

TEST(StepOutcome, LargerSizesAreNoAdviceForSmallWaters) {
  SizeOptions sizes;
  sizes.size_m = sizes.least_m = 3.0;
  sizes.coast = CoastDetail::Follow;
  const auto warning = [&](std::size_t small_waters) {
    const std::vector<std::string> all =
        measureOutcome(strip(10), sizes, inOrder, QualityGoal::Shape, small_waters).warnings;
    return all.empty() ? std::string() : all.front();
  };
  EXPECT_EQ(warning(0).find("narrower than an element"), std::string::npos);
  EXPECT_NE(warning(1).find("in the 1 part narrower than an element, which stays as in the input, larger sizes do not "
                            "help: a smaller --size-min does, or leave it out with --where"),
            std::string::npos)
      << warning(1);
  EXPECT_NE(warning(2).find("leave them out"), std::string::npos) << warning(2);
}

TEST(StepOutcome, ShortEdgesOfRepairsNameThem) {
  SizeOptions sizes;
  sizes.size_m = sizes.least_m = 3.0;
  const auto warning = [&](bool splits, const Point& place) {
    const std::vector<Repair> repairs{{TargetDefectKind::OneNeighbour, Target::Fesom, place, "a repair", splits}};
    return measureOutcome(strip(30), sizes, inOrder, QualityGoal::Shape, 0, repairs).warnings.at(0);
  };
  const std::string text = warning(true, {8.5, 0.5});
  EXPECT_NE(text.find(" of all are where repairs for a model split edges, the shortest at (8.5, 0.5) (one neighbour)"),
            std::string::npos)
      << text;
  EXPECT_EQ(warning(false, {8.5, 0.5}).find("repairs"), std::string::npos);
  EXPECT_EQ(warning(true, {8.5, 50.0}).find("repairs"), std::string::npos);
}

// The advice for a short edge between features is of no use between regions, nor is it for a mesh of one feature.
TEST(StepOutcome, ShortEdgesAtBordersNameWhatTheBorderIsOf) {
  Grid grid = strip(10);
  grid.feature_of.assign(grid.triangles.size(), 0);
  std::fill(grid.feature_of.begin() + 10, grid.feature_of.end(), 1u);
  SizeOptions sizes;
  sizes.size_m = 10.0;
  sizes.coast = CoastDetail::Follow;
  // The shortest edge is where the features meet, after three squares.
  for (const std::uint32_t node : {10u, 11u}) grid.nodes[node].x -= 0.25;
  const auto warnings = [&](const GridFeature& a, const GridFeature& b) {
    grid.features = {a, b};
    std::string all;
    for (const std::string& warning : measureOutcome(grid, sizes, inOrder).warnings) all += warning + '\n';
    return all;
  };
  EXPECT_NE(warnings({1, "a.shp", {}}, {2, "a.shp", {}}).find("--dissolve makes them one"), std::string::npos);
  EXPECT_NE(warnings({1, "a.shp", {}}, {1, "b.shp", {}}).find("--dissolve makes them one"), std::string::npos);
  const std::string of_regions = warnings({1, "a.shp", {}, "bay"}, {1, "a.shp", {}});
  EXPECT_NE(of_regions.find("border of a region"), std::string::npos) << of_regions;
  EXPECT_EQ(of_regions.find("--dissolve"), std::string::npos) << of_regions;
  EXPECT_EQ(warnings({1, "a.shp", {}}, {1, "a.shp", {}}).find("the shortest edge"), std::string::npos);
}

// A wedge of two lines, or one line that turns sharply, makes edges that no size lengthens.
TEST(StepOutcome, ShortEdgesAtLinesNameThem) {
  Grid grid = strip(10);
  SizeOptions sizes;
  sizes.size_m = 10.0;
  sizes.coast = CoastDetail::Follow;
  const auto warning = [&](double size_m) {
    grid.size_m.assign(grid.nodes.size(), size_m);
    const std::vector<std::string> all = measureOutcome(grid, sizes, inOrder).warnings;
    return all.empty() ? std::string() : all.front();
  };
  EXPECT_EQ(warning(10.0), "");
  grid.lines = {{LineKind::Constraint, "dike", false, {6, 8}}};
  grid.boundaries.clear();
  EXPECT_EQ(warning(4.0), "");
  EXPECT_NE(warning(10.0).find("the worst of 1 m instead of 10 m at ("), std::string::npos) << warning(10.0);
  EXPECT_NE(warning(10.0).find("where constraint 'dike' turns sharply"), std::string::npos) << warning(10.0);
  grid.lines.push_back({LineKind::Weir, "dam", false, {9, 11}});
  EXPECT_NE(warning(10.0).find("constraint 'dike' meets or comes close to weir 'dam':"), std::string::npos)
      << warning(10.0);
  grid.lines[1].kind = LineKind::RegionBorder;
  EXPECT_NE(warning(10.0).find("comes close to region border 'dam':"), std::string::npos) << warning(10.0);
  grid.lines[0].kind = LineKind::RegionBorder;
  EXPECT_EQ(warning(10.0), "");
}

// A shore as in the data has short edges of its own.
TEST(StepOutcome, LinesBesideAFineShoreAreNotToBlame) {
  SizeOptions sizes;
  sizes.size_m = 10.0;
  const auto warnings = [&](double width) {
    Grid grid = strip(10);
    for (Point& node : grid.nodes) node.y *= width;
    grid.boundaries.resize(2);  // the shores, with edges of 1
    grid.lines = {{LineKind::Constraint, "dike", false, {6, 7}}};
    grid.size_m.assign(grid.nodes.size(), 10.0);
    return measureOutcome(grid, sizes, inOrder).warnings.size();
  };
  EXPECT_EQ(warnings(0.6), 0u);
  EXPECT_EQ(warnings(0.4), 1u);
  sizes.coast = CoastDetail::Follow;
  EXPECT_EQ(warnings(0.6), 1u);
}

TEST(StepOutcome, OpenBoundariesAreNoCoast) {
  Grid grid = strip(10);
  for (Boundary& boundary : grid.boundaries) boundary.role = BoundaryRole::Open;
  grid.size_m.assign(grid.nodes.size(), 3.0);
  SizeOptions sizes;
  sizes.size_m = 3.0;
  EXPECT_EQ(measureOutcome(grid, sizes, inOrder).notes.size(), 0u);
}

}  // namespace
}  // namespace coastmesh
