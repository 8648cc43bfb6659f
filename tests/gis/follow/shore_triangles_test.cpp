#include "gis/follow/shore_triangles.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/metric.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/shore/shore_chains.hpp"

namespace coastmesh {
namespace {

// The number of points after sampling the shores of a ring of water where sizes are 1.
std::size_t sampled(const std::vector<Point>& ring) {
  ShoreGraph graph;
  const auto count = static_cast<VertexId>(ring.size());
  for (VertexId i = 0; i < count; ++i) {
    graph.pslg.points.push_back(ring[i]);
    graph.pslg.segments.push_back({i, (i + 1) % count, 0, 0, kOutside});
    graph.source.push_back(i);
  }
  sampleShores(graph, ConstantSize(1.0));
  EXPECT_EQ(graph.source.size(), graph.pslg.points.size());
  EXPECT_EQ(graph.pslg.segments.size(), graph.pslg.points.size());
  return graph.pslg.points.size();
}

TEST(SampleShores, WhatGoesOnFromASegmentIsNoOtherShore) {
  EXPECT_EQ(sampled({{0.0, 0.0}, {10.0, 0.0}, {11.0, 5.0}, {10.0, 10.0}, {0.0, 10.0}, {-1.0, 5.0}}), 6u);
}

TEST(SampleShores, BothSidesOfNarrowWater) {
  EXPECT_EQ(sampled({{0.0, 0.0}, {10.0, 0.0}, {10.5, 0.45}, {10.0, 0.9}, {0.0, 0.9}, {-0.5, 0.45}}),
            6u + 2u * 29u + 4u * 2u);
}

TEST(SampleShores, BothSidesOfASharpCorner) {
  // A spit of land that reaches far into the water.
  const std::vector<Point> ring = {{0.0, 0.0},   {20.0, 0.0},  {20.0, 9.9}, {10.0, 10.0},
                                   {20.0, 10.1}, {20.0, 20.0}, {0.0, 20.0}};
  EXPECT_GT(sampled(ring), 2u * 29u);
}

TEST(SampleShores, WhatPointsAtASegment) {
  // A spike ends half an element away from the opposite shore.
  const std::vector<Point> ring = {{0.0, 0.0},  {30.0, 0.0},  {30.0, 10.0}, {16.0, 10.0},
                                   {15.0, 0.5}, {14.0, 10.0}, {0.0, 10.0}};
  EXPECT_GT(sampled(ring), 7u + 89u);
}

TEST(SampleShores, WhatWasCutIsWholeAgain) {
  const std::vector<Point> ring = {{0.0, 0.0}, {10.0, 0.0}, {10.5, 0.45}, {10.0, 0.9}, {0.0, 0.9}, {-0.5, 0.45}};
  ShoreGraph graph;
  for (VertexId i = 0; i < 6; ++i) {
    graph.pslg.points.push_back(ring[i]);
    graph.pslg.segments.push_back({i, (i + 1) % 6, 0, 0, kOutside});
    graph.source.push_back(i);
  }
  sampleShores(graph, ConstantSize(1.0));
  ASSERT_GT(graph.pslg.points.size(), 6u);
  ShoreChains chains = chainsOf(std::move(graph), ConstantSize(1.0));
  chains.at[10].y += 0.01;  // moved since sampling: it stays, and so do its neighbours
  dropSamples(chains);
  const ShoreGraph left = graphOf(std::move(chains));
  ASSERT_EQ(left.pslg.points.size(), 9u);
  for (VertexId i = 0; i < 6; ++i) EXPECT_EQ(left.pslg.points[i], ring[i]);
}

// A star-shaped island in the sea; the left side is an open boundary.
ShoreGraph starInTheSea() {
  ShoreGraph graph;
  const auto add = [&](const std::vector<Point>& ring, bool is_island) {
    const auto first = static_cast<VertexId>(graph.pslg.points.size()), count = static_cast<VertexId>(ring.size());
    for (VertexId i = 0; i < count; ++i) {
      graph.pslg.points.push_back(ring[i]);
      graph.source.push_back(first + i);
      Segment s{first + i, first + (i + 1) % count, 0, 0, kOutside};
      if (is_island) std::swap(s.left, s.right);
      graph.pslg.segments.push_back(s);
    }
  };
  add({{0, 0}, {40, 0}, {40, 40}, {0, 40}}, false);
  graph.pslg.segments[3].tag = kOpenTag;
  std::vector<Point> star;
  for (int i = 0; i < 14; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 14, radius = i % 2 == 0 ? 8.0 : 4.0;
    star.push_back({20.0 + radius * std::cos(angle), 20.0 + radius * std::sin(angle)});
  }
  add(star, true);
  return graph;
}

// 1 on the shore, plus a fifth of the distance to it.
class FromShore final : public SizeFunction {
 public:
  explicit FromShore(const Pslg& pslg) : pslg_(pslg) {}
  double at(const Point& x) const override {
    double least = 1e300;
    for (const Segment& s : pslg_.segments)
      if (s.tag != kOpenTag) least = std::min(least, squaredDistanceToSegment(x, pslg_.points[s.a], pslg_.points[s.b]));
    return 1.0 + 0.2 * std::sqrt(least);
  }
  double least() const override { return 1.0; }
  double most() const override { return 100.0; }

 private:
  Pslg pslg_;
};

TEST(ShoreTriangles, SizesThatGrowEvenlyFollowFromTheirVertices) {
  const FromShore size(starInTheSea().pslg);
  const ConstantSize on_shore(1.0);
  const EvenSizes even{0.2, on_shore};
  // Only vertices on the shore have the shore's size.
  const ShoreChains chains = chainsOf(starInTheSea(), size, inOrder, &even);
  for (VertexId v = 0; v < chains.at.size(); ++v) EXPECT_DOUBLE_EQ(chains.size[v], size.at(chains.at[v])) << v;

  ShoreGraph graph = starInTheSea(), same = starInTheSea();
  sampleShores(graph, size, {}, inOrder, &even);
  sampleShores(same, size);
  ASSERT_EQ(graph.pslg.points.size(), same.pslg.points.size());
  const ShoreTriangles by_vertices = triangulateShores(std::move(graph), size, inOrder, &even);
  const ShoreTriangles asked = triangulateShores(std::move(same), size);
  ASSERT_EQ(by_vertices.mesh.triangles.size(), asked.mesh.triangles.size());
  std::size_t narrow = 0;
  for (TriId t = 0; t < asked.size.size(); ++t) {
    EXPECT_GE(by_vertices.size[t], asked.size[t] * (1.0 - 1e-12));
    if (asked.width[t] > 2.0) continue;
    ++narrow;  // only narrow water is judged by size
    EXPECT_LE(by_vertices.size[t], asked.size[t] * 1.1);
  }
  EXPECT_GT(narrow, 10u);
}

}  // namespace
}  // namespace coastmesh
