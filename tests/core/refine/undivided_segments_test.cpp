#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "core/optimise/optimise.hpp"
#include "core/quality.hpp"
#include "core/refine/check.hpp"
#include "core/refine/refine.hpp"
#include "core/triangulate/delaunay.hpp"

namespace coastmesh {
namespace {

// A ragged ring of `corners` points around a square hole of four, in which every second side, and the hole, stay whole.
Pslg raggedRing(unsigned corners, std::mt19937_64& random) {
  std::uniform_real_distribution<double> radius(9.0, 10.0);
  Pslg pslg;
  for (unsigned i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners, r = radius(random);
    pslg.points.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  for (unsigned i = 0; i < corners; ++i)
    pslg.segments.push_back({i, (i + 1) % corners, 0, 0, kOutside, i % 2 == 0 ? Divide::Never : Divide::Freely});
  const std::array<Point, 4> hole{Point{-1.0, -1.0}, {-1.0, 1.0}, {1.0, 1.0}, {1.0, -1.0}};
  for (unsigned i = 0; i < 4; ++i) {
    pslg.points.push_back(hole[i]);
    pslg.segments.push_back({corners + i, corners + (i + 1) % 4, 0, 0, kOutside, Divide::Never});
  }
  return pslg;
}

std::size_t dividedEdges(const TriMesh& mesh, const Pslg& pslg, Divide divide) {
  std::size_t count = 0;
  for (const Triangle& t : mesh.triangles)
    for (unsigned i = 0; i < 3; ++i) {
      if (t.seg[i] >= pslg.segments.size() || pslg.segments[t.seg[i]].divide != divide) continue;
      if (t.v[next3(i)] >= pslg.points.size() || t.v[prev3(i)] >= pslg.points.size()) ++count;
    }
  return count;
}

TEST(UndividedSegments, StayEdgesThroughAllStages) {
  std::mt19937_64 random(11);
  for (const double length : {0.5, 1.0, 5.0}) {
    for (const unsigned corners : {40u, 60u, 100u}) {
      const Pslg pslg = raggedRing(corners, random);
      const ConstantSize size(length);
      for (const SizeFunction* const wanted :
           {static_cast<const SizeFunction*>(nullptr), static_cast<const SizeFunction*>(&size)}) {
        RefineOptions options;
        options.size = wanted;
        if (wanted == nullptr) options.size_max = length;
        TriMesh mesh = constrainedDelaunay(pslg);
        refine(mesh, pslg, options);
        coarsen(mesh, pslg, options);
        optimise(mesh, pslg, options, 3);
        EXPECT_EQ(dividedEdges(mesh, pslg, Divide::Never), 0u);
        if (length == 0.5) {
          EXPECT_GT(dividedEdges(mesh, pslg, Divide::Freely), 0u);
        }
        EXPECT_TRUE(checkMesh(mesh, &pslg, {}).empty());
      }
    }
  }
}

TEST(UndividedSegments, OfAnElementsLengthLeaveAnglesAsLarge) {
  std::mt19937_64 random(12);
  const Pslg pslg = raggedRing(30, random);
  const ConstantSize size(2.0);
  RefineOptions options;
  options.size = &size;
  TriMesh mesh = constrainedDelaunay(pslg);
  refine(mesh, pslg, options);
  coarsen(mesh, pslg, options);
  optimise(mesh, pslg, options, 3);
  CheckOptions bounds;
  bounds.min_angle_deg = 30.0;
  EXPECT_TRUE(checkMesh(mesh, &pslg, bounds).empty());
}

// A strip between long edges that stay whole and a shore of short ones.
Pslg strip(std::mt19937_64& random) {
  std::uniform_real_distribution<double> share(0.0, 1.0);
  Pslg pslg;
  constexpr unsigned kLong = 6, kShort = 40;
  for (unsigned i = 0; i <= kLong; ++i) pslg.points.push_back({4.0 * i, 0.3 * share(random)});
  for (unsigned i = 0; i <= kShort; ++i)
    pslg.points.push_back({4.0 * kLong * (kShort - i) / kShort, 2.5 + 1.5 * share(random)});
  const auto n = static_cast<unsigned>(pslg.points.size());
  for (unsigned i = 0; i < n; ++i)
    pslg.segments.push_back({i, (i + 1) % n, 0, 0, kOutside, i < kLong ? Divide::Never : Divide::Freely});
  return pslg;
}

TEST(UndividedSegments, NoVertexIsPutSoNearThatNoGoodTriangleFits) {
  std::mt19937_64 random(13);
  for (int run = 0; run < 30; ++run) {
    const Pslg pslg = strip(random);
    const ConstantSize size(1.0);
    for (const SizeFunction* const wanted :
         {static_cast<const SizeFunction*>(nullptr), static_cast<const SizeFunction*>(&size)}) {
      RefineOptions options;
      options.size = wanted;
      TriMesh mesh = constrainedDelaunay(pslg);
      refine(mesh, pslg, options);
      double least = 180.0;
      for (const Triangle& t : mesh.triangles)
        for (const SegmentId s : t.seg)
          if (s < pslg.segments.size() && !mayDivide(pslg, s))
            least = std::min(least, leastAngleDeg(mesh.points[t.v[0]], mesh.points[t.v[1]], mesh.points[t.v[2]]));
      EXPECT_GT(least, 5.0);
    }
  }
}

double leastAngleOf(const TriMesh& mesh) {
  double least = 180.0;
  for (const Triangle& t : mesh.triangles)
    least = std::min(least, leastAngleDeg(mesh.points[t.v[0]], mesh.points[t.v[1]], mesh.points[t.v[2]]));
  return least;
}

// Smaller sizes than their lengths allow put no vertices close beside them.
TEST(UndividedSegments, AreNotSpoilt) {
  std::mt19937_64 random(13);
  std::uniform_real_distribution<double> place(-1.0, 1.0), length(0.3, 2.0);
  int narrow = 0;
  for (int run = 0; run < 300; ++run) {
    // Half of them triangles, half quadrilaterals.
    Pslg pslg;
    pslg.points = {{-3.0 + place(random), place(random)}, {2.0 + place(random), -1.0 + place(random)}};
    if (run % 2 == 1) pslg.points.push_back({3.0 + place(random), 2.0 + place(random)});
    pslg.points.push_back({place(random), 3.0 + place(random)});
    const auto corners = static_cast<std::uint32_t>(pslg.points.size());
    for (std::uint32_t i = 0; i < corners; ++i)
      pslg.segments.push_back({i, (i + 1) % corners, 0, 0, kOutside, Divide::Never});
    const ConstantSize size(length(random));
    RefineOptions options;
    options.size = &size;
    TriMesh mesh = constrainedDelaunay(pslg);
    const double before = leastAngleOf(mesh);
    refine(mesh, pslg, options);
    coarsen(mesh, pslg, options);
    optimise(mesh, pslg, options, 3);
    EXPECT_GE(leastAngleOf(mesh), std::min(before, 10.0)) << run;
    narrow += before < 33.0 ? 1 : 0;
  }
  EXPECT_GT(narrow, 30);
}

}  // namespace
}  // namespace coastmesh
