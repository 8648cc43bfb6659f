// Inputs of several parts and ranges, which are processed at the same time.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <vector>

#include "core/links.hpp"
#include "core/predicates.hpp"
#include "core/triangulate/delaunay.hpp"
#include "tests/support/item_loops.hpp"
#include "tests/support/mesh_figures.hpp"

namespace coastmesh {
namespace {

void addRing(Pslg& pslg, const Point& centre, double radius, int corners, RegionId inside, RegionId outside) {
  const auto first = static_cast<VertexId>(pslg.points.size());
  const auto n = static_cast<VertexId>(corners);
  for (int i = 0; i < corners; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / corners;
    pslg.points.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  for (VertexId i = 0; i < n; ++i) pslg.segments.push_back({first + i, first + (i + 1) % n, 0, inside, outside});
}

// A sea of region 0 with lakes of region 1 on islands, and free points. Some segments are not Delaunay edges: the sea's
// sides are long.
Pslg seaWithLakes() {
  Pslg pslg;
  pslg.points = {{-1.0, -1.0}, {21.0, -1.0}, {21.0, 21.0}, {-1.0, 21.0}};
  for (VertexId i = 0; i < 4; ++i) pslg.segments.push_back({i, (i + 1) % 4, 0, 0, kOutside});
  for (int x = 0; x < 20; ++x) {
    for (int y = 0; y < 20; ++y) {
      addRing(pslg, {x + 0.5, y + 0.5}, 0.4, 40, kOutside, 0);
      addRing(pslg, {x + 0.5, y + 0.5}, 0.2, 20, 1, kOutside);
    }
  }
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> along(-0.99, 20.99);
  for (int i = 0; i < 20000; ++i) {
    const double x = along(random), y = along(random);
    const double from_middle = std::hypot(x - std::floor(x) - 0.5, y - std::floor(y) - 0.5);
    if (x > 0.0 && x < 20.0 && y > 0.0 && y < 20.0 && from_middle < 0.41) continue;
    pslg.points.push_back({x, y});
  }
  return pslg;
}

bool isSame(const TriMesh& a, const TriMesh& b) {
  return a.points == b.points && a.regions == b.regions &&
         std::ranges::equal(a.triangles, b.triangles, [](const Triangle& s, const Triangle& t) {
           return s.v == t.v && s.adj == t.adj && s.seg == t.seg;
         });
}

TEST(LargeDelaunay, DoesNotDependOnTheLoop) {
  const Pslg pslg = seaWithLakes();
  EXPECT_TRUE(isSame(constrainedDelaunay(pslg), constrainedDelaunay(pslg, {}, testing::backwards)));
}

TEST(LargeDelaunay, IsConstrainedDelaunay) {
  const Pslg pslg = seaWithLakes();
  const TriMesh mesh = constrainedDelaunay(pslg);
  ASSERT_EQ(findBrokenLink(mesh.triangles), kNone);
  std::vector<int> sides(pslg.segments.size(), 0);
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      if (mesh.segment(e) != kNone) {
        ++sides[mesh.segment(e)];
        continue;
      }
      ASSERT_NE(mesh.twin(e), kNone);
      ASSERT_LE(inCircle(mesh.point(mesh.apex(e)), mesh.point(mesh.origin(e)), mesh.point(mesh.target(e)),
                         mesh.point(mesh.apex(mesh.twin(e)))),
                0);
    }
  }
  EXPECT_EQ(std::ranges::count(sides, 1), static_cast<long>(sides.size()));  // each has land on one side
}

TEST(LargeDelaunay, RegionsReachFromOneRangeToTheNext) {
  const Pslg pslg = seaWithLakes();
  const auto ring = [](double radius, int n) {
    return 0.5 * n * radius * radius * std::sin(2.0 * std::numbers::pi / n);
  };
  for (const bool labelled : {true, false}) {
    Pslg input = pslg;
    if (!labelled) {
      for (Segment& s : input.segments) s.left = s.right = kUnlabelled;
      for (int x = 0; x < 20; ++x)
        for (int y = 0; y < 20; ++y) input.holes.push_back({x + 0.5 + 0.3, y + 0.5});
    }
    const auto areas = areasByRegion(constrainedDelaunay(input, {}, testing::backwards));
    std::map<RegionId, double> by_region(areas.begin(), areas.end());
    const double sea = 22.0 * 22.0 - 400.0 * ring(0.4, 40), lakes = 400.0 * ring(0.2, 20);
    if (labelled) {
      EXPECT_NEAR(by_region[0], sea, 1e-9 * sea);
      EXPECT_NEAR(by_region[1], lakes, 1e-9 * lakes);
    } else {
      EXPECT_NEAR(by_region[0], sea + lakes, 1e-9 * sea);
    }
  }
}

std::optional<PslgDefect> defectIn(const Pslg& pslg, const ItemLoop& loop) {
  try {
    constrainedDelaunay(pslg, {}, loop);
  } catch (const BadPslg& error) {
    return error.defect;
  }
  return std::nullopt;
}

// The sea's segments and those of an island far from its sides disagree.
TEST(LargeDelaunay, LabelsThatContradictOneAnotherFarApart) {
  Pslg pslg = seaWithLakes();
  constexpr SegmentId kOnAnIsland = 4 + 60 * 210;
  ASSERT_EQ(pslg.segments[kOnAnIsland].right, 0);
  pslg.segments[kOnAnIsland].right = 1;
  const auto one = defectIn(pslg, inOrder), other = defectIn(pslg, testing::backwards);
  ASSERT_TRUE(one && other);
  EXPECT_EQ(one->kind, PslgDefect::Kind::LabelsContradict);
  EXPECT_TRUE(one->segment == kOnAnIsland || one->other == kOnAnIsland);
  EXPECT_EQ(one->segment, other->segment);
  EXPECT_EQ(one->other, other->other);
}

// Of two segments that cross the later one is refused, also if only the earlier one is missing among the edges.
TEST(LargeDelaunay, TheLaterOfTwoCrossingSegmentsIsRefused) {
  Pslg pslg = seaWithLakes();
  pslg.segments.insert(pslg.segments.begin(), {0, 2, 0, 0, 0});
  const auto defect = defectIn(pslg, inOrder);
  ASSERT_TRUE(defect);
  EXPECT_EQ(defect->kind, PslgDefect::Kind::SegmentsCross);
  EXPECT_EQ(defect->other, 0u);
  EXPECT_GT(defect->segment, 0u);
}

}  // namespace
}  // namespace coastmesh
