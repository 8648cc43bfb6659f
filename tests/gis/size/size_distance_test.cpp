#include "gis/size/size_distance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <span>
#include <vector>

#include "core/metric.hpp"
#include "tests/gis/size/size_samples.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

using testing::kInfinity;

TEST(DistanceField, IsTheLeastOverAllLines) {
  std::mt19937_64 random(5);
  std::vector<SizedLine> lines;
  for (int i = 0; i < 300; ++i) {
    const Point a{uniform(random, 0.0, 10.0), uniform(random, 0.0, 10.0)};
    const Point b = i % 5 == 0 ? a : a + Point{uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0)};
    lines.push_back({a, b, uniform(random, 0.1, 2.0), uniform(random, 0.0, 0.5)});
  }
  const DistanceField field(lines, [](const Point&) { return 2.0; });
  std::vector<Point> places;
  std::vector<SizeBox> boxes;
  for (int i = 0; i < 2000; ++i) {
    places.push_back({uniform(random, -5.0, 15.0), uniform(random, -5.0, 15.0)});
    boxes.push_back({places.back(), uniform(random, 0.0, 2.0)});
  }
  std::vector<double> sizes(places.size());
  std::vector<SizeRange> ranges(boxes.size());
  field.sample(places, sizes);
  field.bound(boxes, ranges);
  const auto naive = [&](const Point& x) {
    double least = kInfinity;
    for (const SizedLine& l : lines) {
      // By steps along the line, instead of the foot of a perpendicular.
      double nearest = std::min(distance(x, l.a), distance(x, l.b));
      for (int k = 1; k < 200; ++k) nearest = std::min(nearest, distance(x, l.a + (k / 200.0) * (l.b - l.a)));
      least = std::min(least, l.size_m + l.rate * nearest / 2.0);
    }
    return least;
  };
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_NEAR(sizes[i], naive(places[i]), 2e-3);
    EXPECT_EQ(ranges[i].at_centre, sizes[i]);
    const Point inside = places[i] + boxes[i].half * Point{uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0)};
    EXPECT_GE(naive(inside), ranges[i].low - 1e-9);
    EXPECT_LE(naive(inside), ranges[i].high + 2e-3);
  }
}

TEST(FallingField, IsTheMostOverAllLines) {
  std::mt19937_64 random(15);
  std::vector<SizedLine> lines;
  for (int i = 0; i < 100; ++i) {
    const Point a{uniform(random, 0.0, 10.0), uniform(random, 0.0, 10.0)};
    lines.push_back({a, a, uniform(random, 0.1, 2.0), uniform(random, 0.1, 0.5)});
  }
  FallingField field(lines, [](const Point&) { return 2.0; });
  for (const double most_rate : {1.0, 0.2}) {
    field.limitRate(most_rate);
    for (int i = 0; i < 500; ++i) {
      const Point x{uniform(random, -15.0, 25.0), uniform(random, -15.0, 25.0)};
      const SizeBox box{x, uniform(random, 0.0, 2.0)};
      double size = -1.0;
      SizeRange range;
      field.sample(std::span(&x, 1), std::span(&size, 1));
      field.bound(std::span(&box, 1), std::span(&range, 1));
      const auto naive = [&](const Point& place) {
        double most = 0.0;
        for (const SizedLine& l : lines)
          most = std::max(most, l.size_m - std::min(l.rate, most_rate) * distance(place, l.a) / 2.0);
        return most;
      };
      EXPECT_NEAR(size, naive(x), 1e-9);
      EXPECT_NEAR(range.at_centre, size, 1e-9);
      const Point inside = x + box.half * Point{uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0)};
      EXPECT_GE(naive(inside), range.low - 1e-9);
      EXPECT_LE(naive(inside), range.high + 1e-9);
    }
  }
}

// If all lines have the same size and rate, other code compares squared distances.
TEST(DistanceField, FindsTheNearestOfLinesThatAreAlike) {
  std::mt19937_64 random(6);
  for (const std::size_t count : {1u, 7u, 8u, 9u, 500u}) {
    std::vector<SizedLine> lines;
    for (std::size_t i = 0; i < count; ++i) {
      const Point a{uniform(random, 0.0, 10.0), uniform(random, 0.0, 10.0)};
      lines.push_back(
          {a, i % 5 == 0 ? a : a + Point{uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0)}, 0.5, 0.2});
    }
    constexpr double kMost = 0.9;
    const DistanceField field(
        lines, [](const Point&) { return 1.0; }, kMost);
    std::vector<Point> places;
    std::vector<SizeBox> boxes;
    for (int i = 0; i < 1000; ++i) {
      places.push_back({uniform(random, -5.0, 15.0), uniform(random, -5.0, 15.0)});
      boxes.push_back({places.back(), uniform(random, 0.0, 2.0)});
    }
    std::vector<double> sizes(places.size());
    std::vector<SizeRange> ranges(boxes.size());
    field.sample(places, sizes);
    field.bound(boxes, ranges);
    for (std::size_t i = 0; i < places.size(); ++i) {
      double nearest = kInfinity;
      for (const SizedLine& l : lines) nearest = std::min(nearest, squaredDistanceToSegment(places[i], l.a, l.b));
      EXPECT_NEAR(sizes[i], std::min(kMost, 0.5 + 0.2 * std::sqrt(nearest)), 1e-12);
      EXPECT_EQ(ranges[i].at_centre, sizes[i]);
    }
  }
}

}  // namespace
}  // namespace coastmesh
