#include "gis/shore/shore_mend.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "core/metric.hpp"
#include "gis/shore/shore_pieces.hpp"
#include "tests/support/item_loops.hpp"

namespace coastmesh {
namespace {

// Water between a straight shore and a headland at a distance of `width`, where sizes are 1.
ShoreChains headland(double width) {
  ShoreGraph graph;
  const auto add = [&](double x, double y) {
    graph.pslg.points.push_back({x, y});
    graph.source.push_back(kNone);
  };
  for (int x = -6; x <= 6; ++x) add(x, 0.0);
  for (int x = 6; x >= -6; --x) add(x, width + 0.5 * std::abs(x));
  const auto count = static_cast<VertexId>(graph.pslg.points.size());
  for (VertexId v = 0; v < count; ++v) graph.pslg.segments.push_back({v, (v + 1) % count, 0, 0, kOutside});
  return chainsOf(std::move(graph), ConstantSize(1.0));
}

double narrowest(const ShoreChains& chains) {
  double least = 1e9;
  for (VertexId v = 0; v < chains.at.size(); ++v) {
    for (VertexId w = 0; w < chains.at.size(); ++w) {
      const VertexId x = chains.next[w];
      if (chains.next[v] == kNone || x == kNone || v == w || v == x) continue;
      if (chains.next[x] == v || chains.prev[w] == v || chains.next[v] == w || chains.prev[v] == x) continue;
      least = std::min(least, squaredDistanceToSegment(chains.at[v], chains.at[w], chains.at[x]));
    }
  }
  return std::sqrt(least);
}

TEST(MendShores, WidensWhatIsOnlyJustTooNarrow) {
  for (const double width : {0.2, 0.4, 0.45, 0.485, 0.49, 0.495, 0.4999}) {
    ShoreChains chains = headland(width);
    ASSERT_NEAR(narrowest(chains), width, 1e-12);
    mendShores(
        chains, [](VertexId) {}, [](VertexId, const Point&) {});
    EXPECT_GE(narrowest(chains), 0.5) << width;
  }
}

TEST(MendShores, MovesNothingOutOfTheFrame) {
  for (const bool framed : {false, true}) {
    for (const double width : {0.3, 0.4, 0.45}) {
      ShoreChains chains = headland(width);
      // The straight shore is on the frame, but for rounding.
      if (framed) chains.frame = ShoreFrame({{{-9.0, 1e-13}, {0.5, -1e-13}}, {{0.5, -1e-13}, {9.0, 0.0}}});
      mendShores(
          chains, [](VertexId) {}, [](VertexId, const Point&) {});
      double lowest = 0.0;
      for (const Point& p : chains.at) lowest = std::min(lowest, p.y);
      EXPECT_EQ(lowest > -1e-9, framed) << lowest;
      EXPECT_GE(narrowest(chains), 0.5) << width;
    }
  }
}

TEST(ShorePieces, WhatIsFineAtAGlanceIsAsWanted) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> off(-0.6, 0.6);
  ShoreGraph graph;
  const auto add = [&](const Point& p) {
    graph.pslg.points.push_back(p);
    graph.source.push_back(kNone);
  };
  // Two winding shores, one to three elements apart, and points in the water between them.
  constexpr VertexId kCount = 400;
  for (VertexId i = 0; i < kCount; ++i) add({1.0 * i, off(random)});
  for (VertexId i = kCount; i > 0; --i) add({1.0 * i - 1.0, 1.5 + 0.005 * i + off(random)});
  for (VertexId v = 0; v < 2 * kCount; ++v) graph.pslg.segments.push_back({v, (v + 1) % (2 * kCount), 0, 0, kOutside});
  for (VertexId i = 0; i < kCount; i += 10) add({1.0 * i, 0.9});
  const ShoreChains chains = chainsOf(std::move(graph), ConstantSize(1.0));
  ShorePieces pieces(chains);
  pieces.buildTrees();
  std::size_t fine = 0, as_wanted = 0;
  for (VertexId v = 0; v < 2 * kCount; ++v) {
    pieces.gather(v, 0.0);
    const double quality = pieces.qualityOf(v, chains.at[v]);
    as_wanted += quality == 1.0 ? 1 : 0;
    if (!pieces.isFine(v)) continue;
    ++fine;
    EXPECT_EQ(quality, 1.0) << v;
  }
  EXPECT_GT(fine, 50u);
  EXPECT_GE(fine, as_wanted / 2);
  EXPECT_LT(as_wanted, 2u * kCount);
}

TEST(MendShores, DoesNotDependOnThreads) {
  constexpr VertexId kCount = 20000;  // enough for several stretches
  const auto mended = [](const ItemLoop& loop) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> off(0.0, 1.0);
    ShoreGraph graph;
    for (VertexId v = 0; v < kCount; ++v) {
      const double angle = 2.0 * std::numbers::pi * v / kCount, radius = 2000.0 + off(random);
      graph.pslg.points.push_back({radius * std::cos(angle), radius * std::sin(angle)});
      graph.source.push_back(kNone);
      graph.pslg.segments.push_back({v, (v + 1) % kCount, 0, 0, kOutside});
    }
    ShoreChains chains = chainsOf(std::move(graph), ConstantSize(1.5));
    std::size_t edits = 0;
    mendShores(
        chains, [&](VertexId) { ++edits; }, [&](VertexId, const Point&) { ++edits; }, loop);
    EXPECT_GT(edits, 1000U);
    return chains;
  };
  const ShoreChains one = mended(inOrder), other = mended(testing::backwards);
  EXPECT_EQ(one.at, other.at);
  EXPECT_EQ(one.next, other.next);
}

// A shore with sharp dents below a slanting one that is nowhere near it, but whose box holds all of it.
TEST(MendShores, MendsAllBesideALongSlantingSegment) {
  constexpr VertexId kCount = 300;
  ShoreGraph graph;
  const auto add = [&](double x, double y) {
    graph.pslg.points.push_back({x, y});
    graph.source.push_back(kNone);
  };
  for (VertexId i = 0; i < kCount; ++i) add(i, i % 4 == 1 ? -2.5 : 0.0);
  add(kCount + 600.0, -10.0);
  add(-10.0, kCount + 600.0);
  const auto count = static_cast<VertexId>(graph.pslg.points.size());
  for (VertexId v = 0; v < count; ++v) graph.pslg.segments.push_back({v, (v + 1) % count, 0, 0, kOutside});
  ShoreChains chains = chainsOf(std::move(graph), ConstantSize(1.5));
  for (VertexId v : {VertexId{0}, kCount - 1, kCount, kCount + 1}) chains.stays[v] = 1;
  mendShores(
      chains, [](VertexId) {}, [](VertexId, const Point&) {});
  ShorePieces pieces(chains);
  pieces.buildTrees();
  std::size_t bad = 0;
  for (VertexId v = 2; v + 2 < kCount; ++v) {
    if (chains.next[v] == kNone) continue;
    pieces.gather(v, 0.0);
    bad += pieces.qualityOf(v, chains.at[v]) < 0.99 ? 1 : 0;
  }
  EXPECT_LT(bad, 5u);
}

TEST(MendShores, LeavesWhatIsWideEnough) {
  ShoreChains chains = headland(0.5);
  int edits = 0;
  mendShores(
      chains, [&](VertexId) { ++edits; }, [&](VertexId, const Point&) { ++edits; });
  EXPECT_EQ(edits, 0);
}

}  // namespace
}  // namespace coastmesh
