#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/refine/check.hpp"
#include "core/triangulate/delaunay.hpp"
#include "gis/clean/clean.hpp"
#include "tests/support/cleaned.hpp"
#include "tests/support/gis_shapes.hpp"
#include "tests/support/pslg_check.hpp"

namespace coastmesh {
namespace {

Cleaned cleanWith(const std::vector<Feature>& features, Pinches pinches, double snap = 0) {
  return cleanInPlane(features, {.snap_m = snap, .pinches = pinches});
}

// The number of vertices in which triangles of the domain touch without sharing an edge.
std::size_t pinchesIn(const Pslg& pslg) {
  const TriMesh mesh = constrainedDelaunay(pslg);
  const auto defects = checkMesh(mesh, nullptr, {.delaunay = false, .pinches = true});
  return static_cast<std::size_t>(std::ranges::count(defects, DefectKind::PinchedVertex, &MeshDefect::kind));
}

// The number of parts of the domain that are connected by edges.
std::size_t watersIn(const Pslg& pslg) {
  const TriMesh mesh = constrainedDelaunay(pslg);
  std::vector<char> seen(mesh.triangles.size(), 0);
  std::size_t waters = 0;
  for (TriId first = 0; first < seen.size(); ++first) {
    if (seen[first]) continue;
    ++waters;
    std::vector<TriId> stack{first};
    seen[first] = 1;
    while (!stack.empty()) {
      const TriId t = stack.back();
      stack.pop_back();
      for (const EdgeRef edge : mesh.triangles[t].adj) {
        const TriId next = edge == kNone ? kNone : triOf(edge);
        if (next != kNone && !seen[next]) seen[next] = 1, stack.push_back(next);
      }
    }
  }
  return waters;
}

double shortestEdge(const Pslg& pslg) {
  double shortest = std::numeric_limits<double>::infinity();
  for (const Segment& s : pslg.segments) {
    const Point &a = pslg.points[s.a], &b = pslg.points[s.b];
    shortest = std::min(shortest, std::hypot(b.x - a.x, b.y - a.y));
  }
  return shortest;
}

void expectOpened(const std::vector<Feature>& features, std::size_t pinches, double area, std::size_t waters = 1) {
  const Cleaned kept = cleanWith(features, Pinches::Keep), opened = cleanWith(features, Pinches::Open);
  EXPECT_EQ(pinchesIn(kept.domain.pslg), pinches);
  EXPECT_EQ(kept.count(EditKind::OpenedPinch), 0u);
  EXPECT_EQ(pinchesIn(opened.domain.pslg), 0u);
  EXPECT_EQ(opened.count(EditKind::OpenedPinch), pinches);
  EXPECT_EQ(opened.count(EditKind::TouchingRing), 0u);
  EXPECT_EQ(watersIn(opened.domain.pslg), waters);
  double water = 0;
  for (std::size_t f = 0; f < features.size(); ++f) water += opened.area(static_cast<RegionId>(f));
  EXPECT_GT(water, area);
  EXPECT_LT(water, 1.01 * area);
  EXPECT_GT(shortestEdge(opened.domain.pslg), 0.04 * shortestEdge(kept.domain.pslg));
  // Existing vertices stay, bit for bit.
  for (const Point& p : kept.domain.input_points) {
    EXPECT_EQ(std::ranges::count(opened.domain.input_points, p), 1) << p.x << ", " << p.y;
  }
}

TEST(Pinches, WaterPassesBetweenIslandsThatTouch) {
  const Ring lake = square(0, 0, 10);
  expectOpened({polygonFeature(1, lake, {square(2, 2, 2), square(4, 4, 2)})}, 1, 92);
  // Needles, tip to tip; and blunt corners.
  expectOpened({polygonFeature(1, lake, {{{5, 5}, {8, 4.9}, {8, 5.1}}, {{5, 5}, {2, 5.1}, {2, 4.9}}})}, 1, 99.4);
  expectOpened({polygonFeature(1, lake, {{{5, 5}, {8, 5.2}, {5, 8}, {2, 5.2}}, {{5, 5}, {2, 4.8}, {5, 2}, {8, 4.8}}})},
               1, 82);
}

TEST(Pinches, WaterPassesBetweenAnIslandAndTheShore) {
  const Ring lake = square(0, 0, 10);
  const Cleaned opened = cleanWith({polygonFeature(1, lake, {{{0, 5}, {3, 4}, {3, 6}}})}, Pinches::Open);
  EXPECT_EQ(opened.count(EditKind::OpenedPinch), 1u);
  const Edit& edit = opened.report.edits.back();
  EXPECT_EQ(edit.place, (Point{0, 5}));
  EXPECT_EQ(edit.fid, 1);
  expectOpened({polygonFeature(1, lake, {{{0, 5}, {3, 4}, {3, 6}}})}, 1, 97);
  expectOpened({polygonFeature(1, lake, {{{0, 0}, {3, 1}, {1, 3}}})}, 1, 96);
  // An island that cuts the lake in two.
  expectOpened({polygonFeature(1, lake, {{{5, 0}, {6, 5}, {5, 10}, {4, 5}}})}, 2, 90);
}

TEST(Pinches, ARingThatTouchesItself) {
  // An island of two lobes; a lake of two lobes; a lake that crosses itself.
  expectOpened({polygonFeature(1, square(0, 0, 10), {{{5, 5}, {7, 4}, {7, 6}, {5, 5}, {3, 6}, {3, 4}}})}, 1, 96);
  expectOpened({polygonFeature(1, {{0, 0}, {4, 0}, {4, 4}, {8, 4}, {8, 8}, {4, 8}, {4, 4}, {0, 4}})}, 1, 32);
  expectOpened({polygonFeature(1, {{0, 0}, {4, 4}, {4, 0}, {0, 4}})}, 1, 8);
}

TEST(Pinches, ManyRingsInOneVertex) {
  expectOpened({polygonFeature(1, square(0, 0, 10),
                               {{{5, 5}, {8, 4.5}, {8, 5.5}}, {{5, 5}, {5, 8}, {3, 8}}, {{5, 5}, {2, 5}, {3, 2}}})},
               1, 100 - 1.5 - 3 - 4.5);
  // Pinches at both ends of an edge and at those of its neighbours: every corner of a chequered lake.
  std::vector<Ring> holes;
  for (int i = 0; i < 6; ++i) {
    for (int j = i % 2; j < 6; j += 2) holes.push_back(square(1 + i, 1 + j, 1));
  }
  expectOpened({polygonFeature(1, square(0, 0, 8), holes)}, 25, 64 - 18);
}

TEST(Pinches, LakesThatTouchMeetInAnEdge) {
  const std::vector<Feature> lakes{polygonFeature(1, square(0, 0, 4)), polygonFeature(2, square(4, 4, 4))};
  expectOpened(lakes, 1, 32);
  const Cleaned opened = cleanWith(lakes, Pinches::Open);
  EXPECT_NEAR(opened.area(0), opened.area(1), 1e-12);
  EXPECT_EQ(
      std::ranges::count_if(opened.domain.pslg.segments, [](const Segment& s) { return s.left >= 0 && s.right >= 0; }),
      1);
}

TEST(Pinches, AnEdgeInCommonIsNone) {
  for (const Pinches pinches : {Pinches::Keep, Pinches::Open}) {
    const Cleaned cleaned =
        cleanWith({polygonFeature(1, square(0, 0, 10), {square(2, 2, 2), square(4, 2, 2)})}, pinches);
    EXPECT_EQ(cleaned.count(EditKind::OpenedPinch), 0u);
    EXPECT_EQ(cleaned.area(0), 92);
  }
}

TEST(Pinches, TheGapIsNarrowerWhereLittleRoomIs) {
  // A lake on the island lies just behind the corner that would recede.
  const Ring pond{{0.01, 0.01}, {0.5, 0.01}, {0.01, 0.5}};
  const std::vector<Feature> features{polygonFeature(1, square(-5, -5, 10), {square(0, 0, 2), square(-4, -4, 4)}),
                                      polygonFeature(2, pond)};
  const Cleaned opened = cleanWith(features, Pinches::Open);
  EXPECT_EQ(opened.count(EditKind::OpenedPinch), 1u);
  EXPECT_EQ(pinchesIn(opened.domain.pslg), 0u);
  EXPECT_DOUBLE_EQ(opened.area(1), 0.49 * 0.49 / 2);
}

TEST(Pinches, WhatIsNoLargerThanAFewSnapDistancesGoes) {
  const double snap = 0.001;
  const Ring islet{{4, 4}, {4.003, 4.001}, {4.001, 4.003}};
  Cleaned opened = cleanWith({polygonFeature(1, square(0, 0, 10), {square(2, 2, 2), islet})}, Pinches::Open, snap);
  EXPECT_EQ(opened.count(EditKind::OpenedPinch), 1u);
  EXPECT_EQ(opened.segments(), 8u);
  EXPECT_EQ(opened.area(0), 96);
  // The same for a piece of water, at a corner of the lake.
  Feature lake = polygonFeature(1, square(0, 0, 10));
  lake.polygons.push_back({{{10, 10}, {10.003, 10.001}, {10.001, 10.003}}, {}});
  opened = cleanWith({lake}, Pinches::Open, snap);
  EXPECT_EQ(opened.count(EditKind::OpenedPinch), 1u);
  EXPECT_EQ(opened.domain.pslg.points.size(), 4u);
  EXPECT_EQ(opened.area(0), 100);
  // A larger islet is separated.
  const Ring larger{{4, 4}, {4.3, 4.1}, {4.1, 4.3}};
  opened = cleanWith({polygonFeature(1, square(0, 0, 10), {square(2, 2, 2), larger})}, Pinches::Open, snap);
  EXPECT_EQ(pinchesIn(opened.domain.pslg), 0u);
  EXPECT_NEAR(opened.area(0), 96 - 0.04, 1e-3);
}

// An island with vertices a few snap distances beside its corner: the longer edges determine the width of the gap.
TEST(Pinches, VerticesBesideTheCornerAreNoMeasure) {
  const double snap = 0.001;
  const Ring island{{4, 4}, {4.003, 4}, {6, 4}, {6, 6}, {4, 6}, {4, 4.003}};
  const Cleaned opened =
      cleanWith({polygonFeature(1, square(0, 0, 10), {{{4, 4}, {1, 5}, {5, 1}}, island})}, Pinches::Open, snap);
  EXPECT_EQ(opened.count(EditKind::OpenedPinch), 1u);
  EXPECT_EQ(pinchesIn(opened.domain.pslg), 0u);
  EXPECT_NEAR(opened.area(0), 92, 0.2);
  EXPECT_GT(shortestEdge(opened.domain.pslg), 0.05);
}

TEST(Pinches, TheGapIsWiderThanTheSnapDistance) {
  const std::vector<Feature> features{polygonFeature(1, square(0, 0, 10), {square(2, 2, 2), square(4, 4, 2)})};
  for (const double snap : {0.001, 0.1, 0.3}) {
    const Cleaned opened = cleanWith(features, Pinches::Open, snap);
    EXPECT_EQ(opened.count(EditKind::OpenedPinch), 1u);
    for (std::size_t i = 0; i < opened.domain.pslg.points.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const Point &p = opened.domain.pslg.points[i], &q = opened.domain.pslg.points[j];
        EXPECT_GT(std::hypot(p.x - q.x, p.y - q.y), snap);
      }
    }
  }
}

class PinchesRandom : public ::testing::TestWithParam<unsigned> {};

// Rings on grid points touch in many places, as do tangles where they cross.
TEST_P(PinchesRandom, NoneIsLeft) {
  std::mt19937_64 random(GetParam());
  std::vector<Feature> features;
  for (int f = 0; f < 3; ++f) features.push_back(polygonFeature(f, gridRing(random, 20, 6), {gridRing(random, 8, 6)}));
  if (GetParam() % 3 == 0) features = {polygonFeature(0, tangledRing(random, 5 + GetParam() % 20))};
  const Cleaned kept = cleanWith(features, Pinches::Keep), opened = cleanWith(features, Pinches::Open);
  EXPECT_EQ(opened.count(EditKind::OpenedPinch), pinchesIn(kept.domain.pslg));
  EXPECT_EQ(pinchesIn(opened.domain.pslg), 0u);
  double before = 0, after = 0;
  for (std::size_t f = 0; f < features.size(); ++f) {
    const auto region = static_cast<RegionId>(f);
    before += kept.area(region), after += opened.area(region);
    EXPECT_GE(opened.area(region), kept.area(region) - 1e-12);  // no feature loses water
  }
  EXPECT_LT(after, 1.05 * before);
}

INSTANTIATE_TEST_SUITE_P(Seeds, PinchesRandom, ::testing::Range(0u, 60u));

}  // namespace
}  // namespace coastmesh
