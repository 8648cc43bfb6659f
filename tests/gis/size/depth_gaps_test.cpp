// Depths and sizes of water for which no raster has a depth.
#include "gis/size/depth_gaps.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "gis/long_wave.hpp"
#include "tests/gis/size/size_samples.hpp"

namespace coastmesh {
namespace {

using testing::kInfinity;
using testing::planeDomain;
using testing::rectangle;
using testing::sizesIn;

constexpr double kStep = 10.0;  // seconds

class Gaps : public testing::SizeFiles {
 protected:
  // 20 by 12 km, from 100 m deep in the west to 500 m; unknown in the middle.
  static double depthAt(double x) { return 100.0 + 400.0 * x / 20000.0; }
  static bool inGap(double x, double y) { return x > 6000.0 && x < 14000.0 && y > 3000.0 && y < 9000.0; }

  std::string depths(const std::string& name, bool with_gap = true) {
    return raster(name, 240, 160, {-2000, 100, 0, 14000, 0, -100}, 0,
                  [&](double x, double y) { return with_gap && inGap(x, y) ? -9999.0 : -depthAt(x); });
  }
  SizeOptions stepping(const std::string& bathymetry) {
    SizeOptions options;
    options.size_m = 200.0;
    options.gradation = 0.3;
    options.time_step_s = kStep;
    options.bathymetry = {bathymetry};
    return options;
  }
  static std::vector<Point> places() {
    std::mt19937_64 random(5);
    std::vector<Point> places;
    for (int i = 0; i < 2000; ++i)
      places.push_back({20000.0 * static_cast<double>(random() % 10007) / 10007.0,
                        12000.0 * static_cast<double>(random() % 10007) / 10007.0});
    return places;
  }
};

TEST_F(Gaps, TheTimeStepHoldsInThem) {
  const Domain domain = planeDomain(rectangle(20000.0, 12000.0));
  const auto full = sizesIn(stepping(depths("full.tif", false)), domain);
  const auto gap = sizesIn(stepping(depths("gap.tif")), domain);
  // Sizes are about a tenth larger where depths are uncertain.
  for (const Point& p : places()) EXPECT_NEAR(gap->at(p) / full->at(p), 1.05, 0.12) << p.x << ", " << p.y;
  SizeOptions without = stepping(file("gap.tif"));
  without.gaps = GapFill::None;
  EXPECT_LT(sizesIn(without, domain)->at({10000.0, 6000.0}), 0.7 * full->at({10000.0, 6000.0}));
}

TEST_F(Gaps, WavesAndBandsFollowFromWhatIsAround) {
  const Domain domain = planeDomain(rectangle(20000.0, 12000.0));
  for (const bool waves : {true, false}) {
    SizeOptions options;
    options.gradation = 0.3;
    options.most_m = 2000.0;
    if (waves) options.depth.wave_elements = 2000.0;
    if (!waves) options.depth.bands = {{0.0, 300.0, 400.0}};
    options.bathymetry = {depths("full.tif", false)};
    const auto full = sizesIn(options, domain);
    options.bathymetry = {depths("gap.tif")};
    const auto gap = sizesIn(options, domain);
    for (const Point& p : places()) {
      // The end of the band, from which sizes grow, is known to within about an element.
      EXPECT_NEAR(gap->at(p), full->at(p), waves ? 0.1 * full->at(p) : 240.0) << p.x << ", " << p.y;
    }
  }
}

TEST_F(Gaps, WhatASecondRasterCoversIsNone) {
  const Domain domain = planeDomain(rectangle(20000.0, 12000.0));
  SizeOptions options = stepping(depths("gap.tif"));
  options.bathymetry.push_back(depths("full.tif", false));
  EXPECT_EQ(makeSizeFunction(options, readSizeInputs(options, {}), domain, kInfinity, inOrder).filled.area_m2, 0.0);
  options.bathymetry.pop_back();
  const FilledWater filled = makeSizeFunction(options, readSizeInputs(options, {}), domain, kInfinity, inOrder).filled;
  EXPECT_NEAR(filled.area_m2, 8000.0 * 6000.0, 0.25 * 8000.0 * 6000.0);
  EXPECT_TRUE(inGap(filled.place.x, filled.place.y));
}

// Land needs no depths.
TEST_F(Gaps, LandWithoutDepthsChangesNothing) {
  Pslg pslg = rectangle(20000.0, 12000.0);
  for (const Point& p : {Point{5000, 2000}, {5000, 10000}, {15000, 10000}, {15000, 2000}}) pslg.points.push_back(p);
  for (VertexId i = 0; i < 4; ++i) pslg.segments.push_back({4 + i, 4 + (i + 1) % 4, 0, 0, kOutside});
  const Domain domain = planeDomain(pslg);
  const SizeOptions options = stepping(depths("gap.tif"));
  const DomainSizes sizes = makeSizeFunction(options, readSizeInputs(options, {}), domain, kInfinity, inOrder);
  EXPECT_EQ(sizes.filled.area_m2, 0.0);
  SizeOptions without = options;
  without.gaps = GapFill::None;
  const auto other = sizesIn(without, domain);
  for (const Point& p : places()) EXPECT_EQ(sizes.function->at(p), other->at(p));
}

// A field with depths in a part of the plane: the size for a step of one second.
class KnownIn final : public SizeField {
 public:
  explicit KnownIn(std::function<double(const Point&)> depth) : depth_(std::move(depth)) {}

  void sample(std::span<const Point> places, std::span<double> sizes) const override {
    for (std::size_t i = 0; i < places.size(); ++i) {
      const double depth = depth_(places[i]);
      sizes[i] = std::isnan(depth) ? kInfinity : longWaveSpeed(depth);
    }
  }
  // Samples the whole box, which is exact enough for regions with straight edges.
  void bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const override {
    constexpr int kPlaces = 32;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      ranges[i] = {kInfinity, 0.0};
      for (int k = 0; k <= kPlaces; ++k) {
        for (int j = 0; j <= kPlaces; ++j) {
          const Point p{boxes[i].centre.x + boxes[i].half * (2.0 * k / kPlaces - 1.0),
                        boxes[i].centre.y + boxes[i].half * (2.0 * j / kPlaces - 1.0)};
          double size = 0.0;
          sample(std::span(&p, 1), std::span(&size, 1));
          ranges[i] = {std::min(ranges[i].low, size), std::max(ranges[i].high, size)};
        }
      }
    }
  }

 private:
  std::function<double(const Point&)> depth_;
};

double depthOf(double size) { return size * size / kGravity; }

std::unique_ptr<DepthGaps> gapsOf(const Pslg& pslg, double side, const KnownIn& known, GapFill fill,
                                  const ItemLoop& loop = inOrder) {
  const SizeBox root{{0.5 * side, 0.5 * side}, 0.505 * side};
  const DomainMask mask(pslg, root);
  auto gaps = std::make_unique<DepthGaps>(
      known, mask, root, side / 200.0, [](const Point&) { return 1.0; }, loop);
  if (gaps->any()) gaps->fill(known, mask, depthOf, fill, loop);
  return gaps;
}

// A raster that ends at the sides of the water, as one cut to the frame does, has a depth for all of it.
TEST(DepthGaps, WaterUpToTheEndOfTheRasterIsNone) {
  for (const bool has_gap : {false, true}) {
    const auto isGap = [has_gap](const Point& p) { return has_gap && p.x > 7000 && p.y > 6000; };
    const KnownIn known([&](const Point& p) {
      return p.x < 0 || p.x > 10000 || p.y < 0 || p.y > 10000 || isGap(p) ? std::nan("") : 100.0;
    });
    const Pslg square = rectangle(10000.0, 10000.0);
    // Squares of the quadtree do not end at the sides.
    const SizeBox root{{5000.0, 5000.0}, 5900.0};
    const DomainMask mask(square, root);
    DepthGaps gaps(
        known, mask, root, 1000.0, [](const Point&) { return 1.0; }, inOrder);
    gaps.fill(known, mask, depthOf, GapFill::Mean, inOrder);
    EXPECT_NEAR(gaps.area(), has_gap ? 3000.0 * 4000.0 : 0.0, 1e6) << has_gap;
    if (has_gap) {
      EXPECT_TRUE(isGap(gaps.place())) << gaps.place().x << ", " << gaps.place().y;
    }
  }
}

TEST(DepthGaps, AMembraneIsEvenBetweenEvenEdges) {
  const KnownIn known([](const Point& p) { return p.x > 2000 && p.x < 8000 ? std::nan("") : 100.0 + 0.05 * p.x; });
  const Pslg square = rectangle(10000.0, 10000.0);
  const auto gaps = gapsOf(square, 10000.0, known, GapFill::Mean);
  for (double x = 2100; x < 8000; x += 77)
    for (double y = 50; y < 10000; y += 777) EXPECT_NEAR(gaps->at({x, y}), 100.0 + 0.05 * x, 6.0) << x << ", " << y;
  EXPECT_NEAR(gaps->least(), 200.0, 6.0);
  // Bounds hold for boxes of any size.
  std::mt19937_64 random(9);
  for (int i = 0; i < 2000; ++i) {
    const auto uniform = [&] { return static_cast<double>(random() % 100003) / 100003.0; };
    const SizeBox box{{10000 * uniform(), 10000 * uniform()}, std::pow(10.0, 1 + 2.5 * uniform())};
    const DepthGaps::Range range = gaps->within(box);
    const Point p{box.centre.x + (2 * uniform() - 1) * box.half, box.centre.y + (2 * uniform() - 1) * box.half};
    const double depth = gaps->at(p);
    if (std::isnan(depth) || p.x < 0 || p.x > 10000 || p.y < 0 || p.y > 10000) continue;
    EXPECT_GE(depth, range.least_m - 1e-9);
    EXPECT_LE(depth, range.most_m + 1e-9);
  }
}

TEST(DepthGaps, TheNearestIsHalfAndHalf) {
  const KnownIn known([](const Point& p) {
    return p.x > 2000 && p.x < 8000 ? std::nan("") : p.x < 5000 ? 50.0 : 500.0;
  });
  const auto gaps = gapsOf(rectangle(10000.0, 10000.0), 10000.0, known, GapFill::Nearest);
  EXPECT_NEAR(gaps->at({4500, 5000}), 50.0, 1e-9);
  EXPECT_NEAR(gaps->at({5500, 5000}), 500.0, 1e-9);
}

// Two basins without depths, separated by land except in the known south: neither takes depths through land.
TEST(DepthGaps, LandPartsThem) {
  Pslg pslg;
  pslg.points = {{0, 0},       {10000, 0},   {10000, 10000}, {5500, 10000},
                 {5500, 2000}, {4500, 2000}, {4500, 10000},  {0, 10000}};
  for (VertexId i = 0; i < 8; ++i) pslg.segments.push_back({i, (i + 1) % 8, 0, 0, kOutside});
  const KnownIn known([](const Point& p) {
    if (p.y < 1000) return 30.0;
    return p.y > 9000 ? (p.x < 5000 ? 30.0 : 3000.0) : std::nan("");
  });
  const auto gaps = gapsOf(pslg, 10000.0, known, GapFill::Mean);
  EXPECT_NEAR(gaps->at({2000, 8000}), 30.0, 5.0);
  EXPECT_NEAR(gaps->at({4400, 8000}), 30.0, 5.0);
  EXPECT_GT(gaps->at({8000, 8000}), 2000.0);
}

TEST(DepthGaps, WithoutAnyDepthNothingIsKnown) {
  const KnownIn known([](const Point&) { return std::nan(""); });
  const auto gaps = gapsOf(rectangle(10000.0, 10000.0), 10000.0, known, GapFill::Mean);
  EXPECT_TRUE(std::isnan(gaps->at({5000, 5000})));
  EXPECT_EQ(gaps->within({{5000, 5000}, 100.0}).least_m, kInfinity);
}

TEST(DepthGaps, AnyOrderOfWorkGivesTheSameBits) {
  const KnownIn known([](const Point& p) {
    const double far = std::hypot(p.x - 5000, p.y - 4000);
    return far < 3000 ? std::nan("") : 10.0 + 0.3 * p.y;
  });
  const ItemLoop backwards = [](std::size_t count, const std::function<void(std::size_t)>& work) {
    for (std::size_t i = count; i-- > 0;) work(i);
  };
  const Pslg square = rectangle(10000.0, 10000.0);
  const auto gaps = gapsOf(square, 10000.0, known, GapFill::Mean);
  const auto other = gapsOf(square, 10000.0, known, GapFill::Mean, backwards);
  for (double x = 2100; x < 8000; x += 77)
    for (double y = 1050; y < 7000; y += 177) {
      const double a = gaps->at({x, y}), b = other->at({x, y});
      EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b)));
    }
}

}  // namespace
}  // namespace coastmesh
