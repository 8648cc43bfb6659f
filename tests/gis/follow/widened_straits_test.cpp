// Notes on straits that were widened because they alone join waters.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <utility>
#include <vector>

#include "core/metric.hpp"
#include "gis/follow/coast_follow.hpp"
#include "tests/support/followed_coasts.hpp"

namespace coastmesh {
namespace {

using Cells = std::vector<std::vector<char>>;  // nonzero: water

// Winding channels and lakes of all widths, from some to many cells.
Cells windingWaters(unsigned seed, int side) {
  constexpr int kWaves = 40;
  std::mt19937 random(seed);
  const auto between = [&](double a, double b) { return a + (b - a) * static_cast<double>(random()) / 4294967296.0; };
  std::vector<std::array<double, 3>> waves;
  for (int i = 0; i < kWaves; ++i) {
    const double angle = between(0.0, 6.2832), length = between(7.5, 45.0), phase = between(0.0, 6.2832);
    waves.push_back({std::cos(angle) * 6.2832 / length, std::sin(angle) * 6.2832 / length, phase});
  }
  Cells water(side, std::vector<char>(side, 0));
  for (int x = 1; x + 1 < side; ++x) {
    for (int y = 1; y + 1 < side; ++y) {
      double sum = 0.0;
      for (const auto& [kx, ky, phase] : waves) sum += std::cos(kx * x + ky * y + phase);
      water[x][y] = std::abs(sum) < 3.0;
    }
  }
  return water;
}

// Fills cells with water until none touch at a corner only.
void fillCorners(Cells& water) {
  const int side = static_cast<int>(water.size());
  for (bool changed = true; changed;) {
    changed = false;
    for (int x = 1; x + 2 < side; ++x) {
      for (int y = 1; y + 2 < side; ++y) {
        const char here = water[x][y], there = water[x + 1][y];
        if (here == there || water[x + 1][y + 1] != here || water[x][y + 1] != there) continue;
        water[x][y] = water[x + 1][y] = water[x][y + 1] = water[x + 1][y + 1] = 1;
        changed = true;
      }
    }
  }
}

Domain domainOf(const Cells& water, double cell) {
  Domain domain;
  std::map<std::pair<int, int>, VertexId> numbers;
  const auto vertex = [&](int x, int y) {
    const auto [at, is_new] = numbers.emplace(std::pair(x, y), static_cast<VertexId>(domain.pslg.points.size()));
    if (is_new) domain.pslg.points.push_back({cell * x, cell * y});
    return at->second;
  };
  const auto shore = [&](int x, int y, int to_x, int to_y) {
    domain.pslg.segments.push_back({vertex(x, y), vertex(to_x, to_y), 0, 0, kOutside});
  };
  const int side = static_cast<int>(water.size());
  for (int x = 1; x + 1 < side; ++x) {
    for (int y = 1; y + 1 < side; ++y) {
      if (water[x][y] == 0) continue;
      if (water[x][y - 1] == 0) shore(x, y, x + 1, y);
      if (water[x + 1][y] == 0) shore(x + 1, y, x + 1, y + 1);
      if (water[x][y + 1] == 0) shore(x + 1, y + 1, x, y + 1);
      if (water[x - 1][y] == 0) shore(x, y + 1, x, y);
    }
  }
  domain.input_points = domain.pslg.points;
  return domain;
}

// Widening a strait may close others, so that a water is found, and its strait widened, again.
TEST(WidenedStraits, NoWaterIsCountedTwiceOrWhileStillApart) {
  for (const unsigned seed : {8u, 31u}) {
    Cells water = windingWaters(seed, 240);
    fillCorners(water);
    const Domain domain = domainOf(water, 0.25);
    CleanReport separate, widened;
    followSizes(Domain(domain), ConstantSize(2.0), {.strait_min = 1.0}, oneFeature(), separate);
    followSizes(Domain(domain), ConstantSize(2.0), {.strait_min = 0.2}, oneFeature(), widened);
    EXPECT_GE(widened.waters.joined.count, 10u) << seed;
    EXPECT_LE(widened.waters.joined.count + widened.waters.cut_off.count, separate.waters.cut_off.count) << seed;
  }
}

// A pond in which no element fits, beside a strait that is widened, is no feature of its own any more: its shore
// would stay in the water, as fine as the data.
TEST(WidenedStraits, PondsBesideThemBecomePartOfThem) {
  Coastline features = oneFeature();
  features.features.push_back(features.features.front());
  for (const double low : {10.7, 10.4}) {
    Domain domain = twoLakes(low > 10.5 ? 1.0 : 0.6);
    addShore(domain, {{24.6, low}, {25.4, low}, {25.0, low + 0.8}});
    for (std::size_t i = domain.pslg.segments.size() - 3; i < domain.pslg.segments.size(); ++i)
      domain.pslg.segments[i].left = 1;
    CleanReport report;
    const Domain followed = followSizes(std::move(domain), ConstantSize(2.0), {.strait_min = 0.25}, features, report);
    EXPECT_EQ(report.waters.joined.count, 1u) << low;
    EXPECT_EQ(parts(followed), 1u) << low;
    for (const Segment& s : followed.pslg.segments) {
      EXPECT_TRUE(s.left == kOutside || s.right == kOutside) << low;
      EXPECT_GT(distance(followed.pslg.points[s.a], followed.pslg.points[s.b]), 1.0) << low;
    }
  }
}

}  // namespace
}  // namespace coastmesh
