#include "gis/follow/shore_triangles.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "core/metric.hpp"

namespace coastmesh {
namespace {

// A ring of water with shores of these corners, sampled where sizes are 1; how many points that makes.
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

}  // namespace
}  // namespace coastmesh
