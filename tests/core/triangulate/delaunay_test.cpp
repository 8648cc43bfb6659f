#include "core/triangulate/delaunay.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "core/bulk_list.hpp"
#include "core/metric.hpp"
#include "core/predicates.hpp"
#include "core/quality.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/mesh_figures.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

double totalArea(const TriMesh& mesh) {
  double area = 0.0;
  for (const auto& [region, share] : areasByRegion(mesh)) area += share;
  return area;
}

// Corners of the convex hull by its definition: no point lies to the right of an edge.
std::vector<Point> hullOf(std::vector<Point> points) {
  std::ranges::sort(points, lexLess);
  std::vector<Point> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t start = hull.size();
    for (const Point& p : points) {
      while (hull.size() >= start + 2 && orient2d(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::ranges::reverse(points);
  }
  return hull;
}

class DelaunayOf : public ::testing::TestWithParam<NamedPslg> {};

TEST_P(DelaunayOf, IsValidAndHasTheInputPoints) {
  const Pslg& pslg = GetParam().pslg;
  const TriMesh mesh = constrainedDelaunay(pslg);
  expectValidMesh(mesh, pslg);
  EXPECT_TRUE(std::ranges::equal(mesh.points, pslg.points));
}

TEST_P(DelaunayOf, SegmentsAreEdgesOnBothSides) {
  const Pslg& pslg = GetParam().pslg;
  const TriMesh mesh = constrainedDelaunay(pslg);
  std::vector<int> seen(pslg.segments.size(), 0);
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      const SegmentId s = mesh.segment(e);
      if (s == kNone) continue;
      ++seen[s];
      EXPECT_EQ(std::minmax(mesh.origin(e), mesh.target(e)), std::minmax(pslg.segments[s].a, pslg.segments[s].b));
      const bool along = mesh.origin(e) == pslg.segments[s].a;
      const RegionId label = along ? pslg.segments[s].left : pslg.segments[s].right;
      EXPECT_TRUE(label == kUnlabelled || label == mesh.regions[t]);
      EXPECT_TRUE(mesh.twin(e) == kNone || mesh.segment(mesh.twin(e)) == s);
    }
  }
  for (SegmentId s = 0; s < pslg.segments.size(); ++s) {
    const auto& [a, b, tag, left, right, divide] = pslg.segments[s];
    EXPECT_GE(seen[s], 1);
    EXPECT_TRUE(left < 0 || right < 0 || seen[s] == 2) << "segment " << s;
  }
}

TEST_P(DelaunayOf, DoesNotDependOnTheOrderOfPointsAndSegments) {
  // Rotated, so that no four points are cocircular except within rounding.
  Pslg pslg = turned(GetParam().pslg, 17.0);
  Pslg other = pslg;
  const auto n = static_cast<VertexId>(pslg.points.size());
  std::ranges::reverse(other.points);
  std::ranges::reverse(other.segments);
  for (Segment& s : other.segments) s = {n - 1 - s.b, n - 1 - s.a, s.tag, s.right, s.left};
  EXPECT_EQ(trianglesByPlace(constrainedDelaunay(other)), trianglesByPlace(constrainedDelaunay(pslg)));
}

TEST_P(DelaunayOf, IsTheSameTwice) {
  EXPECT_EQ(digestOf(constrainedDelaunay(GetParam().pslg)), digestOf(constrainedDelaunay(GetParam().pslg)));
}

INSTANTIATE_TEST_SUITE_P(All, DelaunayOf, ::testing::ValuesIn(assortedPslgs()),
                         [](const auto& param_info) { return nameOf(param_info.param); });

TEST(Delaunay, RegionsCoverWhatLabelsEnclose) {
  unsigned labelled = 0;
  for (const NamedPslg& named : assortedPslgs()) {
    SCOPED_TRACE(named.name);
    const Pslg& pslg = named.pslg;
    std::map<RegionId, double> enclosed;
    for (const Segment& s : pslg.segments) {
      const double swept = 0.5 * cross(pslg.points[s.a], pslg.points[s.b]);
      if (s.left >= 0) enclosed[s.left] += swept;
      if (s.right >= 0) enclosed[s.right] -= swept;
    }
    if (enclosed.empty()) continue;
    ++labelled;
    const auto areas = areasByRegion(constrainedDelaunay(pslg));
    ASSERT_EQ(areas.size(), enclosed.size());
    for (const auto& [region, area] : areas) EXPECT_NEAR(area, enclosed[region], 1e-12) << "region " << region;
  }
  EXPECT_GE(labelled, 8u);
}

TEST(Delaunay, Square) {
  const TriMesh mesh = constrainedDelaunay(squarePslg());
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.regions, (BulkList<RegionId>{0, 0}));
  EXPECT_EQ(totalArea(mesh), 1.0);
}

TEST(Delaunay, HolePointCarvesItsFace) {
  EXPECT_NEAR(totalArea(constrainedDelaunay(squareWithHole())), 8.0 / 9.0, 1e-15);
  Pslg whole = squareWithHole();
  whole.holes.clear();
  EXPECT_NEAR(totalArea(constrainedDelaunay(whole)), 1.0, 1e-15);
}

TEST(Delaunay, HolePointOutsideDoesNothing) {
  Pslg pslg = squarePslg();
  pslg.holes = {{5.0, 5.0}, {-3.0, 0.5}};
  EXPECT_EQ(totalArea(constrainedDelaunay(pslg)), 1.0);
}

TEST(Delaunay, OutsideOfConcaveRingIsCarved) {
  const Pslg pslg = combPolygon(4);
  EXPECT_NEAR(totalArea(constrainedDelaunay(pslg)), 4 * 0.1 * (0.2 + 0.5), 1e-12);
}

TEST(Delaunay, WithoutSegmentsTheConvexHull) {
  const Pslg pslg = randomPoints(5, 80);
  const TriMesh mesh = constrainedDelaunay(pslg);
  const std::vector<Point> hull = hullOf(pslg.points);
  EXPECT_EQ(mesh.triangles.size(), 2 * 80 - 2 - hull.size());
  double area = 0.0;
  for (std::size_t i = 1; i + 1 < hull.size(); ++i) area += signedArea(hull[0], hull[i], hull[i + 1]);
  EXPECT_NEAR(totalArea(mesh), area, 1e-12);
  for (const Triangle& t : mesh.triangles)
    for (const Point& p : pslg.points)
      EXPECT_LE(inCircle(pslg.points[t.v[0]], pslg.points[t.v[1]], pslg.points[t.v[2]], p), 0);
}

TEST(Delaunay, PointsOffTheDomainStayWithoutTriangles) {
  Pslg pslg = squareWithHole();
  pslg.points.push_back({0.5, 0.45});  // in the hole
  pslg.points.push_back({2.0, 2.0});   // outside
  const TriMesh mesh = constrainedDelaunay(pslg);
  EXPECT_TRUE(std::ranges::equal(mesh.points, pslg.points));
  EXPECT_EQ(mesh.input_vertices, pslg.points.size());
  for (const Triangle& t : mesh.triangles)
    for (const VertexId v : t.v) EXPECT_LT(v, 8u);
}

TEST(Delaunay, UnlabelledRingInsideALabelledOneIsNoBorder) {
  Pslg pslg = nestedRings();
  const auto before = areasByRegion(constrainedDelaunay(pslg));
  const auto a = static_cast<VertexId>(pslg.points.size());
  pslg.points.insert(pslg.points.end(), {{0.05, 0.05}, {0.15, 0.06}, {0.1, 0.15}});
  for (VertexId i = 0; i < 3; ++i) pslg.segments.push_back({a + i, a + (i + 1) % 3, 0, 0, 0});
  EXPECT_EQ(areasByRegion(constrainedDelaunay(pslg)).size(), before.size());
}

// The defect for which the PSLG is refused; nullopt if it is accepted.
std::optional<PslgDefect> defectIn(const Pslg& pslg) {
  try {
    constrainedDelaunay(pslg);
  } catch (const BadPslg& bad) {
    EXPECT_FALSE(bad.defect.message.empty());
    EXPECT_EQ(bad.what(), bad.defect.message);
    return bad.defect;
  }
  return std::nullopt;
}

using Kind = PslgDefect::Kind;

TEST(PslgDefects, HolesNotFinite) {
  for (const double wrong : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    Pslg pslg = squarePslg();
    pslg.holes = {{0.5, wrong}};
    EXPECT_EQ(defectIn(pslg)->kind, Kind::NotFinite);
  }
}

TEST(PslgDefects, NotFinite) {
  for (const double bad : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
    Pslg pslg = squarePslg();
    pslg.points.push_back({bad, 0.25});
    const auto defect = defectIn(pslg);
    ASSERT_TRUE(defect);
    EXPECT_EQ(defect->kind, Kind::NotFinite);
    EXPECT_EQ(defect->place.y, 0.25);
    pslg.points.back() = {0.25, bad};
    EXPECT_EQ(defectIn(pslg)->kind, Kind::NotFinite);
  }
}

TEST(PslgDefects, HoleThatIsNoPlace) {
  Pslg pslg = squarePslg();
  pslg.holes = {{5.0, std::numeric_limits<double>::quiet_NaN()}};
  ASSERT_TRUE(defectIn(pslg));
  EXPECT_EQ(defectIn(pslg)->kind, Kind::NotFinite);
  pslg.holes = {{5.0, 1e200}};
  EXPECT_EQ(defectIn(pslg)->kind, Kind::OutOfRange);
}

TEST(PslgDefects, OutOfRange) {
  for (const double factor : {1e71, 1e160, 1e308, 1e-71, 1e-160, 5e-324}) {
    SCOPED_TRACE(factor);
    const auto defect = defectIn(scaled(squareWithHole(), factor));
    ASSERT_TRUE(defect);
    EXPECT_TRUE(defect->kind == Kind::OutOfRange || defect->kind == Kind::PointsCoincide);
  }
  Pslg pslg = squarePslg();
  pslg.points.push_back({1e-100, 1e-100});
  const auto defect = defectIn(pslg);
  ASSERT_TRUE(defect);
  EXPECT_EQ(defect->kind, Kind::OutOfRange);
  EXPECT_LE(std::max(defect->place.x, defect->place.y), 1e-100);
}

TEST(PslgDefects, LabelsContradict) {
  Pslg pslg = squarePslg();
  for (Segment& s : pslg.segments) {
    s.left = 0;
    s.right = kOutside;
  }
  pslg.segments[2].left = 1;
  const auto defect = defectIn(pslg);
  ASSERT_TRUE(defect);
  EXPECT_EQ(defect->kind, Kind::LabelsContradict);
  ASSERT_NE(defect->other, kNone);
  EXPECT_NE(pslg.segments[defect->segment].left, pslg.segments[defect->other].left);
  EXPECT_EQ(defect->place.x + defect->place.y,
            0.5 * (pslg.points[pslg.segments[defect->segment].a].x + pslg.points[pslg.segments[defect->segment].b].x +
                   pslg.points[pslg.segments[defect->segment].a].y + pslg.points[pslg.segments[defect->segment].b].y));
}

TEST(PslgDefects, PointsCoincide) {
  Pslg pslg = randomPointsInBox(3, 20);
  pslg.points.push_back(pslg.points[9]);
  const auto defect = defectIn(pslg);
  ASSERT_TRUE(defect);
  EXPECT_EQ(defect->kind, Kind::PointsCoincide);
  EXPECT_EQ(defect->place, pslg.points[9]);
}

TEST(PslgDefects, PointsCoincideThoughZerosDifferInSign) {
  Pslg pslg = squarePslg();
  pslg.points.push_back({-0.0, 0.0});
  const auto defect = defectIn(pslg);
  ASSERT_TRUE(defect);
  EXPECT_EQ(defect->kind, Kind::PointsCoincide);
}

TEST(PslgDefects, SegmentOfNoLength) {
  Pslg pslg = squarePslg();
  pslg.segments.push_back({2, 2});
  const auto defect = defectIn(pslg);
  ASSERT_TRUE(defect);
  EXPECT_EQ(defect->kind, Kind::SegmentOfNoLength);
  EXPECT_EQ(defect->place, pslg.points[2]);
  EXPECT_EQ(defect->segment, 4u);
}

TEST(PslgDefects, UnknownVertex) {
  for (const VertexId unknown : {VertexId{4}, kNone}) {
    Pslg pslg = squarePslg();
    pslg.segments[1].b = unknown;
    const auto defect = defectIn(pslg);
    ASSERT_TRUE(defect);
    EXPECT_EQ(defect->kind, Kind::UnknownVertex);
    EXPECT_EQ(defect->segment, 1u);
  }
}

TEST(PslgDefects, SegmentsCross) {
  Pslg pslg = squarePslg();
  pslg.points.insert(pslg.points.end(), {{0.2, 0.1}, {0.6, 0.9}, {0.1, 0.5}, {0.9, 0.5}});
  pslg.segments.push_back({4, 5});
  pslg.segments.push_back({6, 7});
  const auto defect = defectIn(pslg);
  ASSERT_TRUE(defect);
  EXPECT_EQ(defect->kind, Kind::SegmentsCross);
  EXPECT_EQ((std::set{defect->segment, defect->other}), (std::set<SegmentId>{4, 5}));
  EXPECT_NEAR(defect->place.x, 0.4, 1e-12);
  EXPECT_NEAR(defect->place.y, 0.5, 1e-12);
}

TEST(PslgDefects, PointOnSegment) {
  Pslg pslg = squarePslg();
  pslg.points.push_back({0.25, 0.0});
  const auto defect = defectIn(pslg);
  ASSERT_TRUE(defect);
  EXPECT_EQ(defect->kind, Kind::PointOnSegment);
  EXPECT_EQ(defect->segment, 0u);
  EXPECT_EQ(defect->place, (Point{0.25, 0.0}));
}

TEST(PslgDefects, SegmentsOverlap) {
  // Collinear; the second begins inside the first.
  Pslg pslg = squarePslg();
  pslg.points.insert(pslg.points.end(), {{0.2, 0.5}, {0.6, 0.5}, {0.4, 0.5}, {0.8, 0.5}});
  pslg.segments.push_back({4, 5});
  pslg.segments.push_back({6, 7});
  const auto defect = defectIn(pslg);
  ASSERT_TRUE(defect);
  EXPECT_EQ(defect->kind, Kind::PointOnSegment);
}

TEST(PslgDefects, SegmentTwice) {
  for (const bool backwards : {false, true}) {
    Pslg pslg = squarePslg();
    pslg.segments.push_back(pslg.segments[1]);
    if (backwards) std::swap(pslg.segments.back().a, pslg.segments.back().b);
    const auto defect = defectIn(pslg);
    ASSERT_TRUE(defect) << "two segments between the same vertices meet in more than their ends";
    EXPECT_EQ(defect->kind, Kind::SegmentsCoincide);
    EXPECT_EQ((std::set{defect->segment, defect->other}), (std::set<SegmentId>{1, 4}));
  }
}

TEST(PslgDefects, NoArea) {
  const auto kindOf = [](const Pslg& pslg) {
    const auto defect = defectIn(pslg);
    return defect ? std::optional(defect->kind) : std::nullopt;
  };
  EXPECT_EQ(kindOf({}), Kind::NoArea);
  EXPECT_EQ(kindOf({{{1, 1}}, {}, {}}), Kind::NoArea);
  EXPECT_EQ(kindOf({{{0, 0}, {1, 1}, {2, 2}}, {}, {}}), Kind::NoArea);
  EXPECT_EQ(kindOf({{{0, 0}, {1, 1}, {0, 1}}, {{0, 1}, {1, 2}}, {}}), Kind::NoArea) << "an open line";
  Pslg hole = squarePslg();
  hole.holes.push_back({0.5, 0.5});
  EXPECT_EQ(kindOf(hole), Kind::NoArea);
  Pslg outside = squarePslg();
  for (Segment& s : outside.segments) s.left = s.right = kOutside;
  EXPECT_EQ(kindOf(outside), Kind::NoArea);
}

// Exact predicates: a point one ulp off a segment is not on it.
TEST(PslgDefects, OneUlpOffIsNoDefect) {
  Pslg pslg = squarePslg();
  pslg.points.push_back({0.25, std::nextafter(0.0, 1.0)});
  EXPECT_FALSE(defectIn(pslg));
  expectValidMesh(constrainedDelaunay(pslg), pslg);
}

}  // namespace
}  // namespace coastmesh
