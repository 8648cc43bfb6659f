#include "core/size_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "core/metric.hpp"
#include "core/size_grading.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

// A function that grows no faster than `slope`, and its bounds from that.
class FunctionSource final : public SizeSource {
 public:
  FunctionSource(double least, double slope, std::function<double(const Point&)> f)
      : least_(least), slope_(slope), f_(std::move(f)) {}

  void sample(std::span<const Point> places, std::span<double> sizes) const override {
    std::ranges::transform(places, sizes.begin(), f_);
  }
  void bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const override {
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const double at = f_(boxes[i].centre), reach = slope_ * std::sqrt(2.0) * boxes[i].half;
      ranges[i] = {std::max(least_, at - reach), at + reach};
    }
  }

 private:
  double least_, slope_;
  std::function<double(const Point&)> f_;
};

SizeTree treeOf(const FunctionSource& source, double grade) {
  return {{-1.0, 0.0}, {1.0, 1.0}, source, {.grade = grade}};
}

Point randomPlace(std::mt19937_64& random) { return {uniform(random, -1.0, 1.0), uniform(random, 0.0, 1.0)}; }

TEST(SizeTree, AConstantTakesNoRoom) {
  const SizeTree tree = treeOf(FunctionSource(0.01, 0.0, [](const Point&) { return 0.01; }), 0.2);
  EXPECT_EQ(tree.leaves(), 1u);
  EXPECT_NEAR(tree.at({0.3, 0.4}), 0.01, 1e-8);
  EXPECT_NEAR(tree.least(), 0.01, 1e-8);
  EXPECT_NEAR(tree.most(), 0.01, 1e-8);
}

TEST(SizeTree, LinearSizesComeBack) {
  const auto f = [](const Point& p) { return 0.02 + 0.1 * (p.x + 1.0) + 0.05 * p.y; };
  const SizeTree tree = treeOf(FunctionSource(0.02, 0.12, f), 0.2);
  std::mt19937_64 random(1);
  for (int i = 0; i < 10000; ++i) {
    const Point p = randomPlace(random);
    EXPECT_NEAR(tree.at(p), f(p), 1e-6);
  }
}

TEST(SizeTree, MemoryFollowsTheMesh) {
  const auto leaves = [](double size) {
    return treeOf(FunctionSource(size, 0.2, [=](const Point& p) { return size + 0.2 * std::hypot(p.x, p.y); }), 0.3)
        .leaves();
  };
  // Round one fine place the number of triangles grows with the logarithm of its size.
  const std::size_t some = leaves(1e-3), more = leaves(1e-6);
  EXPECT_LT(more, 3 * some);
  EXPECT_LT(some, 5000u);
}

TEST(SizeTree, BeyondItsBoxTheRimCounts) {
  const SizeTree tree = treeOf(FunctionSource(0.02, 0.1, [](const Point& p) { return 0.13 + 0.1 * p.x; }), 0.2);
  EXPECT_NEAR(tree.at({-50.0, 0.5}), tree.at({-1.01, 0.5}), 1e-6);
  EXPECT_NEAR(tree.at({50.0, 0.5}), tree.at({1.01, 0.5}), 1e-6);
}

TEST(SizeTree, WhereNothingIsWantedItIsAsLargeAsTheWhole) {
  const double none = std::numeric_limits<double>::infinity();
  const SizeTree tree = treeOf(FunctionSource(none, 0.0, [=](const Point&) { return none; }), 0.2);
  EXPECT_GE(tree.at({0.0, 0.5}), 2.0);
  EXPECT_TRUE(std::isfinite(tree.most()));
}

TEST(SizeTree, SaysWhereItIsTooSmall) {
  const FunctionSource source(1e-4, 1.0, [](const Point& p) { return 1e-4 + std::abs(p.y - 0.3); });
  const SizeTree tree({-1.0, 0.0}, {1.0, 1.0}, source, {.grade = 1.0, .most_cells = 1000});
  EXPECT_FALSE(tree.isComplete());
  EXPECT_LE(tree.cells(), 4000u);
}

class GradedTree : public ::testing::TestWithParam<double> {};

// Neighbours in a mesh lie about a size apart.
TEST_P(GradedTree, NoTwoNeighboursDifferMore) {
  const double grade = GetParam();
  const std::vector<FunctionSource> sources = {
      // A step at an oblique edge.
      FunctionSource(0.01, 1e3, [](const Point& p) { return p.x > 0.3 && p.y > 0.4 && p.x + p.y < 0.9 ? 0.01 : 0.2; }),
      FunctionSource(0.002, 1.0, [](const Point& p) { return 0.002 + std::hypot(p.x - 0.123, p.y - 0.456); }),
      FunctionSource(0.03, 2.0,
                     [](const Point& p) { return 0.06 + 0.03 * std::sin(30.0 * p.x) * std::sin(20.0 * p.y); }),
  };
  for (const FunctionSource& source : sources) {
    const SizeTree tree = treeOf(source, grade);
    std::mt19937_64 random(2);
    double most = 0.0;
    for (int i = 0; i < 20000; ++i) {
      const Point p = randomPlace(random);
      const double size = tree.at(p), angle = uniform(random, 0.0, 6.2832), length = size * uniform(random, 0.7, 1.5);
      const Point q = p + Point{length * std::cos(angle), length * std::sin(angle)};
      if (q.x < -1.0 || q.x > 1.0 || q.y < 0.0 || q.y > 1.0) continue;
      most = std::max(most, std::abs(tree.at(q) - size) / length);
    }
    EXPECT_LE(most, grade);
    EXPECT_GE(most, 0.5 * grade) << "graded more than asked";
  }
}

TEST_P(GradedTree, GrowsAsFastAsItMay) {
  const double grade = GetParam();
  // From a fine place as from a point; elsewhere anything.
  const FunctionSource source(0.002, 5.0,
                              [](const Point& p) { return 0.002 + 5.0 * std::hypot(p.x - 0.1, p.y - 0.4); });
  const SizeTree tree = treeOf(source, grade);
  std::mt19937_64 random(3);
  for (int i = 0; i < 10000; ++i) {
    const Point p = randomPlace(random);
    const double most = 0.002 + grade * std::hypot(p.x - 0.1, p.y - 0.4);
    EXPECT_LE(tree.at(p), 1.02 * most + 1e-3);
    EXPECT_GE(tree.at(p), 0.92 * most);
  }
}

INSTANTIATE_TEST_SUITE_P(Grades, GradedTree, ::testing::Values(0.05, 0.15, 0.3));

}  // namespace
}  // namespace coastmesh
