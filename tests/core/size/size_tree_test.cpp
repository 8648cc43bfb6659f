#include "core/size/size_tree.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include "core/metric.hpp"
#include "core/size/size_grading.hpp"
#include "tests/support/item_loops.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

// A function that grows no faster than `slope`; its bounds follow from that.
class FunctionSource final : public SizeSource {
 public:
  FunctionSource(double least, double slope, std::function<double(const Point&)> f)
      : least_(least), slope_(slope), f_(std::move(f)) {}

  void sample(std::span<const Point> places, std::span<double> sizes) const override {
    std::ranges::transform(places, sizes.begin(), f_);
  }
  double least() const { return least_; }
  void bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const override {
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const double at = f_(boxes[i].centre), reach = slope_ * std::sqrt(2.0) * boxes[i].half;
      ranges[i] = {std::max(least_, at - reach), at + reach};
      if (tells_centres) ranges[i].at_centre = at;
    }
  }

  bool tells_centres = false;

 private:
  double least_, slope_;
  std::function<double(const Point&)> f_;
};

SizeTree treeOf(const FunctionSource& source, double gradation) {
  return {{-1.0, 0.0}, {1.0, 1.0}, source, {.gradation = gradation}};
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
  // Around one place of small size, the number of leaves grows with the logarithm of that size.
  const std::size_t some = leaves(1e-3), more = leaves(1e-6);
  EXPECT_LT(more, 3 * some);
  EXPECT_LT(some, 5000u);
}

TEST(SizeTree, BeyondItsBoxTheBoundaryCounts) {
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

// Construction stops at lines and areas as soon as they certainly need too many vertices, but not at a single place,
// which needs few however small its size.
TEST(SizeTree, StopsWhereMoreIsAskedForThanAllowed) {
  const auto cone = [](const Point& p) { return 1e-7 + 0.3 * std::hypot(p.x - 0.1, p.y - 0.4); };
  const auto line = [](const Point& p) { return 1e-6 + 0.3 * std::abs(p.y - 0.4); };
  const SizeTreeOptions options{.gradation = 0.3, .most_vertices = 20'000.0};
  const SizeTree round_one({-1.0, 0.0}, {1.0, 1.0}, FunctionSource(1e-7, 0.3, cone), options);
  EXPECT_TRUE(round_one.isComplete());
  EXPECT_LT(round_one.demand().vertices, 3'000.0);
  const SizeTree along({-1.0, 0.0}, {1.0, 1.0}, FunctionSource(1e-6, 0.3, line), options);
  EXPECT_FALSE(along.isComplete());
  EXPECT_LT(along.cells(), 100'000u);
  // Two sides of a line of length 2.02.
  const double needed = 2.0 / std::sqrt(3.0) * 2.02 * 2.0 / (0.3 * 1e-6);
  EXPECT_NEAR(std::log(along.demand().vertices / needed), 0.0, std::log(3.0));
  EXPECT_NEAR(along.demand().most_in.centre.y, 0.4, along.demand().most_in.half + 1e-9);
  const SizeTree flat({-1.0, 0.0}, {1.0, 1.0}, FunctionSource(1e-3, 0.0, [](const Point&) { return 1e-3; }), options);
  EXPECT_FALSE(flat.isComplete());
  EXPECT_NEAR(flat.demand().vertices, 2.0 / std::sqrt(3.0) * 2.02 * 2.02 / 1e-6, 1.0);
}

// Sizes at the cells' centres reveal the excess long before bounds do. Beside a line along an axis, all centres of a
// level are equally far from it, so they may over- or underestimate the demand; a demand that fits must never be
// rejected for that.
TEST(SizeTree, StopsEarlyWhereALittleMoreIsAskedForThanAllowed) {
  constexpr double kLeast = 5e-5, kSlope = 0.15;
  const auto madeFor = [](double tilt, double most) {
    const double norm = std::hypot(1.0, tilt);
    FunctionSource source(kLeast, kSlope,
                          [=](const Point& p) { return kLeast + kSlope * std::abs(p.y - 0.01 - tilt * p.x) / norm; });
    source.tells_centres = true;
    const double needed = 2.0 / std::sqrt(3.0) * 2.02 * norm * 2.0 / (kSlope * kLeast);
    return SizeTree({-1.0, -1.0}, {1.0, 1.0}, source, {.gradation = 0.3, .most_vertices = most * needed});
  };
  for (const double tilt : {0.0, 0.3, 0.71}) {
    const SizeTree whole = madeFor(tilt, 1.05);
    EXPECT_TRUE(whole.isComplete()) << tilt;
    if (tilt == 0.0) continue;
    const SizeTree stopped = madeFor(tilt, 1.0 / 1.2);
    EXPECT_FALSE(stopped.isComplete()) << tilt;
    EXPECT_LT(3 * stopped.cells(), whole.cells()) << tilt;
    EXPECT_NEAR(stopped.demand().vertices / whole.demand().vertices, 1.0, 0.3) << tilt;
  }
}

TEST(SizeTree, SaysWhereItIsTooSmall) {
  const FunctionSource source(1e-4, 1.0, [](const Point& p) { return 1e-4 + std::abs(p.y - 0.3); });
  const SizeTree tree({-1.0, 0.0}, {1.0, 1.0}, source, {.gradation = 1.0, .most_cells = 1000});
  EXPECT_FALSE(tree.isComplete());
  EXPECT_LE(tree.cells(), 4000u);
}

double distanceTo(const Point& x, const Point& a, const Point& b) {
  const double share = std::clamp(dot(x - a, b - a) / squaredDistance(a, b), 0.0, 1.0);
  return distance(x, a + share * (b - a));
}

class GradedTree : public ::testing::TestWithParam<double> {};

// Distances from 1e-4 to 1, in a box of 2 by 1: within cells and across many. Sources with steps, cones, waves,
// neighbouring cells of all levels, and an area without sizes.
TEST_P(GradedTree, NoTwoPlacesDifferMore) {
  const double gradation = GetParam();
  const double none = std::numeric_limits<double>::infinity();
  const std::vector<FunctionSource> sources = {
      // A step at an oblique edge.
      FunctionSource(0.01, 1e3, [](const Point& p) { return p.x > 0.3 && p.y > 0.4 && p.x + p.y < 0.9 ? 0.01 : 0.2; }),
      FunctionSource(0.002, 1.0, [](const Point& p) { return 0.002 + std::hypot(p.x - 0.123, p.y - 0.456); }),
      FunctionSource(0.03, 2.0,
                     [](const Point& p) { return 0.06 + 0.03 * std::sin(30.0 * p.x) * std::sin(20.0 * p.y); }),
      // As steep as allowed: there is no slack, so interpolation between vertices must not be steeper.
      FunctionSource(0.01, gradation,
                     [=](const Point& p) {
                       return 0.01 + gradation * std::min(distanceTo(p, {-0.5, 0.1}, {0.3, 0.7}),
                                                          distanceTo(p, {0.3, 0.7}, {0.9, 0.3}));
                     }),
      FunctionSource(1e-4, 3.0,
                     [](const Point& p) {
                       return 1e-4 +
                              3.0 * std::min({std::hypot(p.x, p.y - 0.5), 0.01 + std::hypot(p.x - 0.6, p.y - 0.2),
                                              0.1 + std::abs(p.x + 0.7)});
                     }),
      // No size wanted in the east.
      FunctionSource(0.02, 1e3, [=](const Point& p) { return p.x < 0.2 ? 0.02 : none; }),
  };
  for (std::size_t s = 0; s < sources.size(); ++s) {
    const SizeTree tree = treeOf(sources[s], gradation);
    std::mt19937_64 random(2);
    double most = 0.0;
    for (int i = 0; i < 50000; ++i) {
      const Point p = randomPlace(random);
      const double angle = uniform(random, 0.0, 6.2832), length = std::exp(uniform(random, std::log(1e-4), 0.0));
      const Point q = p + Point{length * std::cos(angle), length * std::sin(angle)};
      most = std::max(most, std::abs(tree.at(q) - tree.at(p)) / length);
    }
    EXPECT_LE(most, gradation) << "source " << s;
    EXPECT_GE(most, 0.5 * gradation) << "graded more than asked, source " << s;
    EXPECT_GE(tree.least(), sources[s].least() * (1.0 - 1e-6)) << "source " << s;
  }
}

TEST_P(GradedTree, GrowsAsFastAsItMay) {
  const double gradation = GetParam();
  // A steep cone at one place: after grading, the size grows as from a single point.
  const FunctionSource source(0.002, 5.0,
                              [](const Point& p) { return 0.002 + 5.0 * std::hypot(p.x - 0.1, p.y - 0.4); });
  const SizeTree tree = treeOf(source, gradation);
  std::mt19937_64 random(3);
  for (int i = 0; i < 10000; ++i) {
    const Point p = randomPlace(random);
    const double most = 0.002 + gradation * std::hypot(p.x - 0.1, p.y - 0.4);
    EXPECT_LE(tree.at(p), 1.02 * most + 1e-3);
    EXPECT_GE(tree.at(p), 0.92 * most);
  }
}

// Against the largest function that nowhere exceeds the wanted size or the gradation.
TEST_P(GradedTree, GrowsFromManyPlacesAsFastAsItMay) {
  const double gradation = GetParam();
  std::mt19937_64 random(4);
  std::vector<std::pair<Point, double>> sources;
  for (int i = 0; i < 12; ++i) sources.push_back({randomPlace(random), 0.004 * std::exp(uniform(random, -1.0, 2.0))});
  const auto f = [&](double rate) {
    return [=](const Point& p) {
      double least = 0.4;
      for (const auto& [place, size] : sources) least = std::min(least, size + rate * distance(p, place));
      return least;
    };
  };
  const SizeTree tree = treeOf(FunctionSource(0.001, 3.0, f(3.0)), gradation);
  double sum = 0.0;
  constexpr int kPlaces = 10000;
  for (int i = 0; i < kPlaces; ++i) {
    const Point p = randomPlace(random);
    const double share = tree.at(p) / f(gradation)(p);
    EXPECT_GE(share, 0.75) << p.x << ", " << p.y;
    sum += share / kPlaces;
  }
  EXPECT_GE(sum, 0.93);
  EXPECT_LE(sum, 1.05);
}

// Cells without wanted sizes stay coarse and do not affect their neighbours.
TEST(SizeTree, CoarseWhereNobodyAsks) {
  class Half final : public SizeSource {
   public:
    explicit Half(bool masked) : masked_(masked) {}
    void sample(std::span<const Point> places, std::span<double> sizes) const override {
      std::ranges::transform(places, sizes.begin(), [](const Point& p) { return 0.004 + 0.1 * std::abs(p.y - 0.5); });
    }
    void bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const override {
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        const double at = 0.004 + 0.1 * std::abs(boxes[i].centre.y - 0.5), reach = 0.1 * boxes[i].half;
        ranges[i] = {std::max(0.004, at - reach), at + reach};
      }
    }
    bool isWanted(const SizeBox& box) const override { return !masked_ || box.centre.x - box.half < 0.0; }

   private:
    bool masked_;
  };
  const SizeTreeOptions options{.gradation = 0.2};
  const SizeTree all({-1.0, 0.0}, {1.0, 1.0}, Half(false), options);
  const SizeTree half({-1.0, 0.0}, {1.0, 1.0}, Half(true), options);
  EXPECT_LT(half.leaves(), 6 * all.leaves() / 10);
  std::mt19937_64 random(5);
  for (int i = 0; i < 10000; ++i) {
    const Point p = randomPlace(random);
    if (p.x >= 0.0) continue;
    EXPECT_NEAR(half.at(p), all.at(p), 1e-6);
  }
}

// All parts of a tree, bit for bit: sizes that are not there are NaN.
std::vector<std::vector<std::byte>> partsOf(const SizeTree& tree) {
  std::vector<std::vector<std::byte>> parts;
  const auto add = [&](const auto& items) {
    const auto bytes = std::as_bytes(std::span(items));
    parts.emplace_back(bytes.begin(), bytes.end());
  };
  tree.visitParts([&](const Point& origin, double side, const std::vector<SizeTree::Cell>& cells, const auto& leaves,
                      int start_levels, const auto& start, const auto& start_level, double least, double most) {
    add(std::vector<double>{origin.x, origin.y, side, 1.0 * start_levels, least, most});
    std::vector<std::uint32_t> below;  // without padding
    for (const SizeTree::Cell& cell : cells) below.insert(below.end(), {cell.below, std::uint32_t{cell.is_leaf}});
    add(below);
    add(leaves);
    add(start);
    add(start_level);
  });
  return parts;
}

// Pits and a ridge, steeper than allowed: cells are split because they are bent, and for what grows into them.
TEST(SizeTree, OrderOfRangesDoesNotMatter) {
  const auto f = [](const Point& p) {
    double least = 0.02 + 0.3 * std::abs(p.y - 0.3 - 0.2 * std::sin(3.0 * p.x));
    for (const Point& pit : {Point{-0.7, 0.2}, Point{0.1, 0.8}, Point{0.6, 0.5}})
      least = std::min(least, 0.0007 + 0.5 * distance(p, pit));
    return least;
  };
  for (const bool tells_centres : {false, true}) {
    for (const Surface& surface : {Surface{}, Surface::sphere(1.0)}) {
      FunctionSource source(0.0007, 0.7, f);
      source.tells_centres = tells_centres;
      const SizeTreeOptions options{.surface = surface, .gradation = 0.04, .coarsest = 1.2};
      const auto treeWith = [&](const ItemLoop& loop) {
        return SizeTree({-1.0, 0.0}, {1.0, 1.0}, source, options, loop);
      };
      const SizeTree tree = treeWith(inOrder);
      ASSERT_GT(tree.leaves(), 4u * 8192);  // several ranges
      EXPECT_EQ(partsOf(tree), partsOf(treeWith(testing::backwards)));
    }
  }
}

// Splitting stops at the same cells.
TEST(SizeTree, OrderOfRangesDoesNotMatterIfItIsTooSmall) {
  const FunctionSource source(0.001, 0.3, [](const Point& p) { return 0.001 + 0.3 * std::abs(p.y - 0.4); });
  const SizeTreeOptions options{.gradation = 0.3, .most_cells = 20'000};
  const SizeTree tree({-1.0, 0.0}, {1.0, 1.0}, source, options);
  const SizeTree again({-1.0, 0.0}, {1.0, 1.0}, source, options, testing::backwards);
  EXPECT_FALSE(tree.isComplete());
  EXPECT_LE(tree.cells(), options.most_cells);
  EXPECT_FALSE(again.isComplete());
  EXPECT_EQ(tree.cells(), again.cells());
  EXPECT_EQ(tree.demand().vertices, again.demand().vertices);
}

INSTANTIATE_TEST_SUITE_P(Grades, GradedTree, ::testing::Values(0.05, 0.15, 0.3));

// A pit of one vertex in a field nearly as steep as allowed: tilting triangles alone would take many passes.
TEST(SizeGrading, EndsWithNothingSteep) {
  SizePlaces places;
  std::vector<LeafVertices> leaves;
  constexpr std::uint32_t kCells = 32;
  for (std::uint32_t j = 0; j < kCells; ++j) {
    for (std::uint32_t i = 0; i < kCells; ++i) {
      LeafVertices leaf;
      leaf.fill(kNone);
      for (const std::uint32_t k : {0u, 2u, 4u, 6u, 8u}) leaf[k] = places.add({2 * i + k % 3, 2 * j + k / 3});
      leaves.push_back(leaf);
    }
  }
  GradedSizes sizes;
  for (std::uint32_t v = 0; v < places.size(); ++v) sizes.own.push_back(1.0 + 0.2 * (places[v].x + 0.5 * places[v].y));
  sizes.own[places.find({21, 21})] = 0.5;
  sizes.size = sizes.own;
  sizes.source.assign(places.size(), kNone);
  const double gradation = 0.201 * std::sqrt(1.25);
  const ItemLoop loop = inOrder;
  SizeGrading(sizes, {places, 1.0, {}, {}, gradation}, leaves, loop).flatten();
  for (const LeafVertices& leaf : leaves) {
    forEachTriangle(leaf, [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      // The slope from two edges at right angles.
      const auto place = [&](std::uint32_t v) { return Point{1.0 * places[v].x, 1.0 * places[v].y}; };
      const Point ab = place(b) - place(a), ac = place(c) - place(a);
      ASSERT_EQ(dot(ab, ac), 0.0);
      EXPECT_LE(std::hypot((sizes.size[b] - sizes.size[a]) / std::sqrt(squaredLength(ab)),
                           (sizes.size[c] - sizes.size[a]) / std::sqrt(squaredLength(ac))),
                gradation * (1.0 + 1e-12));
    });
  }
  // Downhill from the pit, sizes hardly change.
  const std::uint32_t below = places.find({10, 4});
  EXPECT_NEAR(sizes.size[below], sizes.own[below], 0.01 * sizes.own[below]);
}

}  // namespace
}  // namespace coastmesh
