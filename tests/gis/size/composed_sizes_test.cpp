#include <gtest/gtest.h>

#include <GeographicLib/Geodesic.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "core/metric.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/size/size_channel.hpp"
#include "gis/size/size_source.hpp"
#include "tests/gis/size/size_samples.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

using testing::kInfinity;
using testing::planeDomain;
using testing::rectangle;
using testing::sizesIn;

double one(const Point&) { return 1.0; }

TEST(ChannelLines, FindTheWidthOfAChannel) {
  // Long sides without vertices: the width must be found between them.
  const std::vector<SizedLine> lines = channelLines(rectangle(100.0, 2.0), 4.0, 0.2, 0.01, 100.0, one).lines;
  ASSERT_GT(lines.size(), 50u);
  double first = 100.0, last = 0.0;
  for (const SizedLine& line : lines) {
    EXPECT_NEAR(line.size_m, 0.5, 1e-6);
    first = std::min(first, line.a.x);
    last = std::max(last, line.a.x);
  }
  EXPECT_LT(first, 3.0);
  EXPECT_GT(last, 97.0);
}

// As narrow as 5e-8 of the extent, along the whole length; the circles start as large as the extent.
TEST(ChannelLines, AreFoundHoweverNarrow) {
  for (const double width : {1.0, 0.1, 0.01}) {
    const double length = 1e4 * width < 2000.0 ? 2000.0 : 1e4 * width;
    Pslg pslg = rectangle(length, width);
    pslg.points.insert(pslg.points.end(), {{2e5, -1e5}, {2e5 + 1, -1e5}, {2e5, 1 - 1e5}});  // another water, far away
    pslg.segments.insert(pslg.segments.end(), {{4, 5, 0, 0, kOutside}, {5, 6, 0, 0, kOutside}, {6, 4, 0, 0, kOutside}});
    const ChannelLines found = channelLines(pslg, 4.0, 0.2, 1e-4, 1e6, one);
    std::array<int, 2> tenths{};  // bits: tenths of the length, along either shore
    for (const SizedLine& line : found.lines)
      if (std::abs(line.size_m - width / 4.0) < 1e-6 * width)
        tenths[line.a.y > 0.5 * width] |= 1 << static_cast<int>(10.0 * line.a.x / length);
    EXPECT_EQ(tenths, (std::array{1023, 1023})) << width;
  }
}

// Edges of half a metre on 200 square metres; two triangles per vertex, each sqrt(3) / 4 times the square of an edge.
TEST(ChannelLines, StopWhereTheyAskForMoreThanIsAllowed) {
  const Pslg channel = rectangle(100.0, 2.0);
  const ChannelLines all = channelLines(channel, 4.0, 0.2, 0.01, 100.0, one);
  ASSERT_TRUE(all.complete);
  const double vertices = 200.0 / (0.5 * 0.5 * std::sqrt(3.0) / 2.0);
  EXPECT_NEAR(all.vertices / vertices, 1.0, 0.15);
  const auto lines = static_cast<double>(all.lines.size());
  for (const ChannelRoom& room : {ChannelRoom{0.1 * vertices, 1e9}, ChannelRoom{1e9, 0.1 * lines}}) {
    const ChannelLines some = channelLines(channel, 4.0, 0.2, 0.01, 100.0, one, room);
    EXPECT_FALSE(some.complete);
    EXPECT_LE(static_cast<double>(some.lines.size()), 0.15 * lines);
    EXPECT_NEAR(some.vertices / vertices, 1.0, 0.3);
  }
}

TEST(ChannelLines, BendsOfOneShoreAreNone) {
  // A sea with a shore of blunt teeth: wide everywhere.
  Pslg pslg;
  for (int i = 0; i <= 40; ++i) pslg.points.push_back({static_cast<double>(i), i % 2 == 0 ? 0.0 : 0.3});
  pslg.points.push_back({40.0, 60.0});
  pslg.points.push_back({0.0, 60.0});
  const auto count = static_cast<VertexId>(pslg.points.size());
  for (VertexId i = 0; i < count; ++i) pslg.segments.push_back({i, (i + 1) % count, 0, 0, kOutside});
  for (const SizedLine& line : channelLines(pslg, 1.0, 0.2, 0.01, 100.0, one).lines) EXPECT_GT(line.size_m, 5.0);
}

// Two triangles of land in an ocean, with tips 1 apart; `angle` at the tips, degrees.
Pslg twoCapes(double angle) {
  const double half = 20.0 * std::tan(toRadians(0.5 * angle));
  Pslg pslg;
  pslg.points = {{-100.0, -50.0}, {100.0, -50.0}, {100.0, 50.0}, {-100.0, 50.0}, {0.0, -0.5},
                 {half, -20.5},   {-half, -20.5}, {0.0, 0.5},    {-half, 20.5},  {half, 20.5}};
  for (VertexId i = 0; i < 4; ++i) pslg.segments.push_back({i, (i + 1) % 4, kOpenTag, 0, kOutside});
  for (const VertexId first : {4, 7})
    for (VertexId i = 0; i < 3; ++i) pslg.segments.push_back({first + i, first + (i + 1) % 3, 0, 0, kOutside});
  return pslg;
}

// Their sides recede from the strait at once: no circle that touches a side is as narrow.
TEST(ChannelLines, TwoCapesAreAsFarApartAsTheirPoints) {
  for (const double angle : {1.0, 40.0, 90.0, 120.0, 160.0}) {
    double least = kInfinity;
    for (const SizedLine& line : channelLines(twoCapes(angle), 4.0, 0.2, 0.01, 100.0, one).lines) {
      least = std::min(least, line.size_m);
      EXPECT_TRUE(line.size_m >= 0.5 || std::abs(line.a.x) < 4.0) << angle;
    }
    EXPECT_NEAR(least, 0.25, 0.005) << angle;
  }
}

TEST(ChannelLines, OpenWaterBesideOneCapeIsNone) {
  Pslg pslg = twoCapes(60.0);
  pslg.segments.resize(7);
  pslg.points.resize(7);
  EXPECT_TRUE(channelLines(pslg, 4.0, 0.2, 0.01, 100.0, one).lines.empty());
}

// A line along the middle of a wide channel, as a constraint or the border of two regions, and a line from a cape.
TEST(ChannelLines, LinesInTheWaterAndBordersAreNoShores) {
  Pslg pslg = twoCapes(60.0);
  const auto linesOf = [](const Pslg& p) { return channelLines(p, 4.0, 0.2, 0.01, 100.0, one).lines; };
  const std::vector<SizedLine> without = linesOf(pslg);
  pslg.points.insert(pslg.points.end(), {{-99.0, 49.0}, {99.0, 49.0}, {3.0, 0.0}});
  pslg.segments.push_back({10, 11, kFirstLineTag, 0, 0});
  pslg.segments.push_back({10, 11, 0, 1, 0});
  pslg.segments.push_back({4, 12, kFirstLineTag, 0, 0});
  const std::vector<SizedLine> with = linesOf(pslg);
  ASSERT_EQ(with.size(), without.size());
  for (std::size_t i = 0; i < with.size(); ++i) {
    EXPECT_EQ(with[i].a, without[i].a);
    EXPECT_EQ(with[i].b, without[i].b);
    EXPECT_EQ(with[i].size_m, without[i].size_m);
  }
}

TEST(ComposedSizes, ShoreDistanceInThePlane) {
  SizeOptions options;
  options.shore_m = 0.05;
  options.shore_rate = 0.1;
  options.most_m = 0.3;
  const Domain domain = planeDomain(rectangle(20.0, 10.0));
  const auto size = sizesIn(options, domain);
  std::mt19937_64 random(7);
  for (int i = 0; i < 2000; ++i) {
    const Point p{uniform(random, 0.0, 20.0), uniform(random, 0.0, 10.0)};
    const double d = std::min({p.x, p.y, 20.0 - p.x, 10.0 - p.y});
    const double wanted = std::min(0.3, 0.05 + 0.1 * d);
    EXPECT_NEAR(size->at(p) / wanted, 1.0, 0.04) << p.x << ", " << p.y;
  }
}

TEST(ComposedSizes, RoughOnesAreOffByATenthAndSmaller) {
  SizeOptions options;
  options.shore_m = 100.0;
  options.shore_rate = 0.2;
  options.channel_elements = 0.01;  // needs nothing here, but only a map shows that
  const Domain domain = planeDomain(rectangle(10000.0, 6000.0));
  const auto made = [&](SizeAccuracy accuracy) {
    return makeSizeFunction(options, {}, domain, kInfinity, inOrder, accuracy).function;
  };
  const auto rough = made(SizeAccuracy::Rough), fine = made(SizeAccuracy::Fine);
  EXPECT_LE(dynamic_cast<const SizeTree&>(*rough).cells(), dynamic_cast<const SizeTree&>(*fine).cells());
  std::mt19937_64 random(3);
  for (int i = 0; i < 2000; ++i) {
    const Point x{uniform(random, 0.0, 10000.0), uniform(random, 0.0, 6000.0)};
    const double wanted = 100.0 + 0.2 * std::min({x.x, 10000.0 - x.x, x.y, 6000.0 - x.y});
    EXPECT_NEAR(rough->at(x) / wanted, 1.0, 0.15);
  }
}

TEST(ComposedSizes, RoughOnesByTheShoreAloneAreExactAndNoMap) {
  SizeOptions options;
  options.shore_m = 100.0;
  options.shore_rate = 0.2;
  options.least_m = 150.0;
  options.most_m = 600.0;
  Domain domain = planeDomain(rectangle(10000.0, 6000.0));
  domain.pslg.segments[3].tag = kOpenTag;  // the left side
  const auto made = [&](double most_vertices) {
    return makeSizeFunction(options, {}, domain, most_vertices, inOrder, SizeAccuracy::Rough);
  };
  const DomainSizes sizes = made(kInfinity);
  EXPECT_EQ(dynamic_cast<const SizeTree*>(sizes.function.get()), nullptr);
  EXPECT_EQ(sizes.rate, 0.2);
  EXPECT_EQ(sizes.shore_m, 150.0);
  EXPECT_EQ(leastWanted(options, {}), 150.0);
  std::mt19937_64 random(3);
  std::vector<Point> places;
  for (int i = 0; i < 2000; ++i) places.push_back({uniform(random, 0.0, 10000.0), uniform(random, 0.0, 6000.0)});
  std::vector<double> sampled(places.size());
  sizes.function->sample(places, sampled);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Point& x = places[i];
    const double wanted = std::clamp(100.0 + 0.2 * std::min({10000.0 - x.x, x.y, 6000.0 - x.y}), 150.0, 600.0);
    EXPECT_NEAR(sizes.function->at(x) / wanted, 1.0, 1e-9);
    EXPECT_DOUBLE_EQ(sampled[i], sizes.function->at(x));
    EXPECT_LE(sizes.function->least(), wanted);
    EXPECT_GE(sizes.function->most(), wanted);
  }
  // If the shore may need more vertices than allowed, a map decides, and is made or refused.
  EXPECT_NE(dynamic_cast<const SizeTree*>(made(1000.0).function.get()), nullptr);
  EXPECT_THROW(made(100.0), TooManyVertices);
  options.channel_elements = 2.0;
  EXPECT_EQ(leastWanted(options, {}), 150.0);
  options.least_m = 0.0;
  EXPECT_EQ(leastWanted(options, {}), 0.0);
  EXPECT_TRUE(std::isnan(made(kInfinity).rate));
}

TEST(ComposedSizes, ChannelsHaveTheirElementsAcross) {
  SizeOptions options;
  options.size_m = 0.4;
  options.least_m = 0.001;
  options.channel_elements = 5.0;
  const Domain domain = planeDomain(narrowChannel(0.1));
  const auto size = sizesIn(options, domain);
  double least = kInfinity;
  for (const Point& p : domain.pslg.points) least = std::min(least, size->at(p));
  EXPECT_NEAR(least, 0.02, 0.003);
  EXPECT_GT(size->most(), 0.1);
}

// As requested: in metres, along geodesics. Far from the centre of such a plane, the scale is not 1 and varies.
TEST(ComposedSizes, GradedOnTheGround) {
  for (const double rate : {0.05, 0.2, 1.0}) {
    Coastline coast;
    coast.crs = wgs84();
    coast.features.emplace_back();
    coast.features.back().polygons.push_back(
        {{{-60.0, 0.0}, {0.0, -10.0}, {20.0, 50.0}, {-10.0, 75.0}, {-70.0, 60.0}}, {}});
    CleanReport report;
    const Projection projection = Projection::fitted(coast, {0});
    const Domain domain = cleanFeatures(coast, {0}, projection, {}, report);
    SizeOptions options;
    options.shore_m = 20000.0;
    options.shore_rate = rate;
    options.gradation = 0.2;
    const auto size = sizesIn(options, domain, coast.crs);
    const GeographicLib::Geodesic& geodesic = GeographicLib::Geodesic::WGS84();
    std::mt19937_64 random(9);
    double most = 0.0, largest = 0.0;
    for (int i = 0; i < 20000; ++i) {
      const Point a{uniform(random, -50.0, 0.0), uniform(random, 5.0, 60.0)};
      const double reach = std::exp(uniform(random, std::log(1e-3), std::log(20.0)));
      const Point b = a + reach * Point{uniform(random, -1.0, 1.0), uniform(random, -1.0, 1.0)};
      double metres = 0.0;
      geodesic.Inverse(a.y, a.x, b.y, b.x, metres);
      const auto sizeAt = [&](const Point& p) {
        const Point place = projection.forward(p);
        return size->at(place) / projection.scaleAt(place);
      };
      most = std::max(most, std::abs(sizeAt(b) - sizeAt(a)) / metres);
      largest = std::max(largest, sizeAt(a));
    }
    EXPECT_LE(most, 0.2);
    EXPECT_GE(most, 0.8 * std::min(rate, 0.2));
    EXPECT_GT(largest, 20000.0 + 0.8 * std::min(rate, 0.18) * 1e6) << "not graded that much";
  }
}

}  // namespace
}  // namespace coastmesh
