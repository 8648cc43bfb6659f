#include "gis/solver/work.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <numeric>

#include "gis/elements/elements.hpp"
#include "gis/error.hpp"
#include "gis/solver/partition_grid.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Work, WeightsAreWholeAndInProportion) {
  EXPECT_THAT(wholeWeights({1.0, 2.0, 3.0}), ElementsAre(500, 1000, 1500));
  EXPECT_THAT(wholeWeights({0.0, 1e-3}), ElementsAre(1, 2000));
}

// Scotch adds weights in 32 bits.
TEST(Work, WeightsOfManyFit32Bits) {
  const std::vector<std::int32_t> weights = wholeWeights(std::vector<double>(3'000'000, 0.7));
  EXPECT_LT(std::accumulate(weights.begin(), weights.end(), std::int64_t{0}), std::numeric_limits<std::int32_t>::max());
  EXPECT_EQ(weights.front(), 358);
}

Grid lakes() { return coastmesh::testing::sampleGrid(Crs{}, {0.0, 0.0}, 10.0, 20); }

// What a part has of a value at nodes, at most and on average.
double mostOverMean(const std::vector<std::uint32_t>& part_of, const std::vector<double>& values, std::uint32_t parts) {
  std::vector<double> sums(parts, 0.0);
  for (std::size_t n = 0; n < values.size(); ++n) sums.at(part_of[n]) += values[n];
  return std::ranges::max(sums) * parts / std::accumulate(sums.begin(), sums.end(), 0.0);
}

TEST(Work, PartsShareAnAttribute) {
  Grid grid = lakes();
  NodeField field{"cost"};
  for (const Point& node : grid.nodes) field.values.push_back(node.x < 100.0 ? 20.0 : 1.0);
  grid.node_fields.push_back(field);
  const PartitionReport even = partitionGrid(grid, {.parts = 4, .nodes = true});
  EXPECT_EQ(even.weight, "even");
  EXPECT_GT(mostOverMean(grid.node_part_of, field.values, 4), 1.5);
  const PartitionReport report =
      partitionGrid(grid, {.parts = 4, .elements = true, .nodes = true, .attribute = "cost"});
  EXPECT_EQ(report.weight, "cost");
  EXPECT_LE(mostOverMean(grid.node_part_of, field.values, 4), kMostImbalance + 0.001);
  EXPECT_NEAR(report.nodes->balance, mostOverMean(grid.node_part_of, field.values, 4), 1e-3);
  // An element has the mean of its nodes.
  std::vector<double> of_triangles;
  for (const auto& [a, b, c] : grid.triangles)
    of_triangles.push_back((field.values[a] + field.values[b] + field.values[c]) / 3.0);
  EXPECT_NEAR(report.elements->balance, mostOverMean(grid.part_of, of_triangles, 4), 1e-3);
}

TEST(Work, PartsShareLayers) {
  Grid grid = lakes();
  grid.z.clear();
  for (const Point& node : grid.nodes) grid.z.push_back(node.x < 100.0 ? -5.0 : -800.0);
  const VerticalLevels levels{{}, SzLevels{4, {10, 200, 400, 600, 900}}};
  const PartitionReport report = partitionGrid(grid, {.parts = 4, .elements = true, .nodes = true, .levels = levels});
  EXPECT_EQ(report.weight, "layers");
  const Elements elements(grid);
  EXPECT_LE(mostOverMean(grid.node_part_of, layersOfNodes(grid, elements, levels), 4), kMostImbalance + 0.001);
  EXPECT_LE(mostOverMean(grid.part_of, layersOfElements(grid, elements, levels), 4), kMostImbalance + 0.001);
}

TEST(Work, OfNoUseIsNamed) {
  Grid grid = lakes();
  const auto refused = [&](const std::string& why) {
    try {
      workOfNodes(grid, "cost");
      FAIL() << why;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(why));
    }
  };
  refused("--partition-weight cost: the mesh has no such attribute");
  grid.node_fields.push_back({"other", {}, 0, 1.0, std::vector<double>(grid.nodes.size(), 1.0)});
  refused("for each node, but: other");
  grid.node_fields.push_back({"cost", {}, 0, 1.0, std::vector<double>(grid.nodes.size(), 0.0)});
  refused("it is 0 at every node");
  grid.node_fields.back().values[4] = std::numeric_limits<double>::quiet_NaN();
  refused("it is unknown at node 5 at (");
  grid.node_fields.back().values[3] = std::numeric_limits<double>::infinity();
  refused("it is unknown at node 4 at (");
  grid.node_fields.back().values[2] = -1.0;
  refused("it is negative at node 3 at (");
}

}  // namespace
}  // namespace coastmesh
