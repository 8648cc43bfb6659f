#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>

#include "core/metric.hpp"
#include "core/size/estimate_vertices.hpp"
#include "core/size/on_surface.hpp"
#include "core/size/plane_sizes.hpp"
#include "core/size/size_tree.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

// The Earth in kilometres, except a cap of about 24 degrees around the antipode of the projection centre, where the
// plane is enlarged at least 23 times.
constexpr double kRadius = 6371.0, kExtent = 6e4;
const Surface kSphere = Surface::sphere(kRadius);
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// A function that grows no faster than `slope` on the sphere; its bounds follow from that.
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
      const double reach = slope_ * std::sqrt(2.0) * boxes[i].half * shrinkIn(kSphere, boxes[i]).high;
      const double at = f_(boxes[i].centre);
      ranges[i] = {std::max(least_, at - reach), at + reach};
    }
  }

 private:
  double least_, slope_;
  std::function<double(const Point&)> f_;
};

SizeTree treeOf(const SizeSource& source, double gradation) {
  return {{-kExtent, -kExtent}, {kExtent, kExtent}, source, {.surface = kSphere, .gradation = gradation}};
}

// Uniform on the sphere, within the square.
Point randomPlace(std::mt19937_64& random) {
  while (true) {
    const double up = uniform(random, -1.0, 1.0), turn = uniform(random, 0.0, 2.0 * std::numbers::pi);
    const double away = 2.0 * kRadius * std::sqrt((1.0 - up) / (1.0 + up));
    const Point place{away * std::cos(turn), away * std::sin(turn)};
    if (std::max(std::abs(place.x), std::abs(place.y)) < kExtent) return place;
  }
}

double arc(const Point& a, const Point& b) { return arcBetween(kSphere, a, b); }

// True if the great-circle arc stays in the square, which gets a margin of 1 %.
bool isInside(const Point& a, const Point& b) {
  const Frame frame(kSphere, a);
  const Point to = frame.to(b);
  constexpr int kSteps = 64;
  for (int k = 0; k <= kSteps; ++k) {
    const double share = std::tan(k * std::atan(std::sqrt(kSphere.curvature * squaredLength(to))) / kSteps) /
                         std::sqrt(kSphere.curvature * squaredLength(to));
    const Point on = frame.from(share * to);
    if (!(std::max(std::abs(on.x), std::abs(on.y)) < 1.01 * kExtent)) return false;
  }
  return true;
}

TEST(SizeTreeOnSphere, AConstantTakesLittleRoomAndAsksForTheSpheresArea) {
  const SizeTree tree = treeOf(FunctionSource(100.0, 0.0, [](const Point&) { return 100.0; }), 0.2);
  EXPECT_LT(tree.leaves(), 20'000u);
  std::mt19937_64 random(1);
  for (int i = 0; i < 1000; ++i) EXPECT_NEAR(tree.at(randomPlace(random)), 100.0, 1e-4);
  const double area = areaOn(kSphere, SizeBox{{0.0, 0.0}, 1.01 * kExtent});
  EXPECT_NEAR(tree.demand().vertices / (2.0 / std::sqrt(3.0) * area / 1e4), 1.0, 2e-3);
}

class GradedTreeOnSphere : public ::testing::TestWithParam<double> {};

// Distances from metres to the whole Earth; steps, cones, waves, sources near the antipode, and an area without sizes.
TEST_P(GradedTreeOnSphere, NoTwoPlacesDifferMore) {
  const double gradation = GetParam();
  const std::vector<std::pair<const char*, FunctionSource>> sources = {
      {"step", FunctionSource(150.0, 1e3, [](const Point& p) { return p.x > 2e4 && p.y > -1e3 ? 150.0 : 900.0; })},
      {"cone far out", FunctionSource(5.0, 1.0,
                                      [](const Point& p) {
                                        return 5.0 + arc(p, {3e4, 2e4});
                                      })},
      {"cone at the middle", FunctionSource(5.0, 1.0,
                                            [](const Point& p) {
                                              return 5.0 + arc(p, {100.0, 200.0});
                                            })},
      {"waves",
       FunctionSource(
           100.0, 0.5,
           [](const Point& p) {
             return 200.0 + 100.0 * std::sin(arc(p, {1e4, 0.0}) / 300.0) * std::sin(arc(p, {-3e4, 3e4}) / 400.0);
           })},
      {"as steep as allowed",
       FunctionSource(
           20.0, gradation,
           [=](const Point& p) {
             return 20.0 + gradation * std::min({arc(p, {2e4, 0.0}), arc(p, {-4e4, 3e4}), arc(p, {0.0, 0.0})});
           })},
      {"nothing wanted in the east",
       FunctionSource(150.0, 1e3, [=](const Point& p) { return p.x < 2e3 ? 150.0 : kInfinity; })},
  };
  for (const auto& [name, source] : sources) {
    const SizeTree tree = treeOf(source, gradation);
    std::mt19937_64 random(2);
    double most = 0.0;
    for (int i = 0; i < 20'000; ++i) {
      const Point p = randomPlace(random);
      // Three of four are near p, in its frame; the others are anywhere.
      const double turn = uniform(random, 0.0, 2.0 * std::numbers::pi);
      const double away = std::exp(uniform(random, std::log(1e-3), std::log(3e3)));
      const Point q =
          i % 4 == 0 ? randomPlace(random) : Frame(kSphere, p).from({away * std::cos(turn), away * std::sin(turn)});
      if (!isInside(p, q)) continue;
      most = std::max(most, std::abs(tree.at(q) - tree.at(p)) / arc(p, q));
    }
    EXPECT_LE(most, gradation) << name;
    EXPECT_GE(most, 0.5 * gradation) << "graded more than asked: " << name;
    EXPECT_GE(tree.least(), source.least() * (1.0 - 1e-6)) << name;
  }
}

// Against the largest function that nowhere exceeds the wanted size or the gradation.
TEST_P(GradedTreeOnSphere, GrowsFromManyPlacesAsFastAsItMay) {
  const double gradation = GetParam();
  std::mt19937_64 random(4);
  std::vector<std::pair<Point, double>> places;
  for (int i = 0; i < 12; ++i) places.push_back({randomPlace(random), 10.0 * std::exp(uniform(random, -1.0, 2.0))});
  const auto f = [&](double rate) {
    return [=](const Point& p) {
      double least = 2000.0;
      for (const auto& [place, size] : places) least = std::min(least, size + rate * arc(p, place));
      return least;
    };
  };
  const SizeTree tree = treeOf(FunctionSource(2.0, 3.0, f(3.0)), gradation);
  double sum = 0.0;
  constexpr int kPlaces = 10000;
  for (int i = 0; i < kPlaces; ++i) {
    const Point p = randomPlace(random);
    const double share = tree.at(p) / f(gradation)(p);
    EXPECT_GE(share, 0.75) << p.x << ", " << p.y;
    sum += share / kPlaces;
  }
  EXPECT_GE(sum, 0.92);
  EXPECT_LE(sum, 1.05);
}

INSTANTIATE_TEST_SUITE_P(Grades, GradedTreeOnSphere, ::testing::Values(0.05, 0.15, 0.3));

// The same cone at the projection centre and where the plane is enlarged 20 times: sizes around both agree.
TEST(SizeTreeOnSphere, NoPlaceIsSpecial) {
  const Point far{4e4, 4e4};
  const Frame frame(kSphere, far);
  const auto cone = [](const Point& p) { return 2.0 + 3.0 * std::sqrt(squaredLength(p)); };
  const auto coneOn = [&](const Point& apex) {
    return FunctionSource(2.0, 3.0, [&cone, apex](const Point& p) { return cone({arc(apex, p), 0.0}); });
  };
  const SizeTree here = treeOf(coneOn({0.0, 0.0}), 0.2), there = treeOf(coneOn(far), 0.2);
  std::mt19937_64 random(6);
  for (int i = 0; i < 2000; ++i) {
    const double away = uniform(random, 1.0, 1500.0), turn = uniform(random, 0.0, 2.0 * std::numbers::pi);
    const Point off{away * std::cos(turn), away * std::sin(turn)};
    if (!isInside(far, frame.from(off))) continue;
    EXPECT_NEAR(there.at(frame.from(off)) / here.at(off), 1.0, 0.2) << away;
  }
}

TEST(SizeTreeOnSphere, PlaneSizesAreTheLengthsInThePlane) {
  const ConstantSize wanted(50.0);
  const PlaneSizes sizes(wanted, kSphere, {-kExtent, -kExtent}, {kExtent, kExtent});
  std::mt19937_64 random(7);
  for (int i = 0; i < 1000; ++i) {
    const Point p = randomPlace(random);
    const double length = sizes.at(p);
    // A segment of that length, centred at p.
    const Point half{0.5 * length, 0.0};
    EXPECT_NEAR(kSphere.chord(p - half, p + half), 50.0, 0.05);
    EXPECT_LE(length, sizes.most());
    EXPECT_GE(length, sizes.least());
  }
  EXPECT_LE(sizes.at({1e9, 1e9}), sizes.most()) << "wherever it is asked";
}

TEST(SizeTreeOnSphere, SegmentsCountByTheirLengthOnTheSphere) {
  // A straight segment out to where the plane is greatly enlarged; none of it counts as short.
  Pslg pslg;
  pslg.points = {{1e4, 0.0}, {5e4, 0.0}};
  pslg.segments.push_back({0, 1, 0, 0, kOutside});
  const double lengths = arc(pslg.points[0], pslg.points[1]) / 20.0;
  EXPECT_NEAR(verticesOfSegments(pslg, ConstantSize(20.0), 1e9, kSphere) / (0.5 * lengths), 1.0, 0.01);
}

}  // namespace
}  // namespace coastmesh
