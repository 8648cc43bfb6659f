#include "core/lattice/lattice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "core/lattice/lattice_core.hpp"
#include "core/metric.hpp"
#include "core/triangulate/delaunay.hpp"
#include "core/triangulate/label_regions.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

std::vector<Point> pointsOf(const LatticePlaces& some) {
  std::vector<Point> points;
  for (const LatticePlace& p : placesIn(some.places)) points.push_back(some.lattice.at(p.a, p.b));
  return points;
}

bool isInside(const TriMesh& mesh, const Point& p) {
  return std::ranges::any_of(mesh.triangles, [&](const Triangle& t) {
    for (unsigned i = 0; i < 3; ++i)
      if (cross(mesh.point(t.v[next3(i)]) - mesh.point(t.v[i]), p - mesh.point(t.v[i])) < 0.0) return false;
    return true;
  });
}

double distanceToInput(const Pslg& pslg, const TriMesh& mesh, const Point& p) {
  double nearest = std::numeric_limits<double>::infinity();
  // Without segments, the boundary is that of the convex hull.
  for (const Triangle& t : mesh.triangles)
    for (unsigned i = 0; i < 3; ++i)
      if (t.adj[i] == kNone)
        nearest = std::min(nearest, squaredDistanceToSegment(p, mesh.point(t.v[next3(i)]), mesh.point(t.v[prev3(i)])));
  for (const Segment& s : pslg.segments)
    nearest = std::min(nearest, squaredDistanceToSegment(p, pslg.points[s.a], pslg.points[s.b]));
  for (const Point& q : pslg.points) nearest = std::min(nearest, squaredDistance(p, q));
  return std::sqrt(nearest);
}

class LatticeOn : public ::testing::TestWithParam<NamedPslg> {};

// Lattice places in the domain at least two spacings from the input, and no others. Each place is checked separately.
TEST_P(LatticeOn, TakesWhatIsInsideAndClear) {
  const Pslg& pslg = GetParam().pslg;
  const TriMesh mesh = constrainedDelaunay(pslg);
  double area = 0.0;
  for (const Triangle& t : mesh.triangles)
    area += 0.5 * cross(mesh.point(t.v[1]) - mesh.point(t.v[0]), mesh.point(t.v[2]) - mesh.point(t.v[0]));
  const double spacing = std::sqrt(area / 2000.0);
  const ConstantSize size(spacing);
  const std::vector<LatticePlaces> found = layLattices(mesh, {.size = &size, .most_places = 100000});
  if (found.empty()) return;
  ASSERT_EQ(found.size(), 1u);
  const Lattice& lattice = found.front().lattice;
  EXPECT_EQ(lattice.spacing, spacing);
  std::map<std::pair<double, double>, int> taken;
  for (const Point& p : pointsOf(found.front())) ++taken[{p.x, p.y}];
  std::size_t expected = 0;
  for (std::int64_t b = 0; b < 400; ++b) {
    for (std::int64_t a = -400; a < 400; ++a) {
      const Point p = lattice.at(a, b);
      const double clear = distanceToInput(pslg, mesh, p);
      const bool is_taken = taken.contains({p.x, p.y});
      // Rounding decides at exactly that distance.
      if (std::abs(clear - 2.0 * spacing) >= 1e-9 * spacing) {
        EXPECT_EQ(is_taken, clear > 2.0 * spacing && isInside(mesh, p)) << p.x << " " << p.y;
      }
      expected += is_taken;
    }
  }
  EXPECT_EQ(taken.size(), expected);
}

using Corners = std::array<std::pair<double, double>, 3>;

// Lattice triangles only: other cocircular points can be triangulated in several ways.
std::vector<Corners> equilateralOnes(const TriMesh& mesh) {
  std::vector<Corners> all;
  for (const Triangle& t : mesh.triangles) {
    const Point &a = mesh.point(t.v[0]), &b = mesh.point(t.v[1]), &c = mesh.point(t.v[2]);
    const auto [least, most] = std::ranges::minmax({distance(a, b), distance(b, c), distance(c, a)});
    if (least < most * (1.0 - 1e-9)) continue;
    Corners corners;
    for (unsigned i = 0; i < 3; ++i) corners[i] = {mesh.point(t.v[i]).x, mesh.point(t.v[i]).y};
    std::ranges::rotate(corners, std::ranges::min_element(corners));
    all.push_back(corners);
  }
  std::ranges::sort(all);
  return all;
}

// The triangulation of all points equals that of the rest plus the cores' own triangles.
TEST_P(LatticeOn, CoresAreTheirPartOfTheTriangulation) {
  const Pslg& pslg = GetParam().pslg;
  const TriMesh mesh = constrainedDelaunay(pslg);
  const std::vector<LatticePlaces> places = layLattices(mesh, {.size_max = 0.02, .most_places = 1000000});
  if (places.empty()) return;
  const LatticeMesh plain = triangulateWith(pslg, places, false);
  EXPECT_TRUE(plain.cores.empty());
  EXPECT_EQ(plain.mesh.input_vertices, pslg.points.size());
  LatticeMesh cored = triangulateWith(pslg, places, true);
  EXPECT_EQ(cored.mesh.triangles.size() + cored.coreTriangles(), plain.mesh.triangles.size());
  EXPECT_EQ(cored.mesh.points.size() + cored.coreVertices(), plain.mesh.points.size());
  if (cored.cores.empty()) return;
  insertCores(cored.mesh, cored.pslg_vertices, cored.cores);
  EXPECT_EQ(equilateralOnes(cored.mesh), equilateralOnes(plain.mesh));
  EXPECT_GE(equilateralOnes(cored.mesh).size(), cored.coreTriangles());
  for (const Triangle& t : cored.mesh.triangles)
    for (const SegmentId s : t.seg) EXPECT_NE(s, kFrozen);
  labelRegions(cored.mesh, pslg);
  expectValidMesh(cored.mesh, pslg);
}

INSTANTIATE_TEST_SUITE_P(All, LatticeOn, ::testing::ValuesIn(assortedPslgs()),
                         [](const auto& param_info) { return nameOf(param_info.param); });

TEST(LatticeCores, LieInAllButNarrowDomains) {
  const TriMesh mesh = constrainedDelaunay(squarePslg());
  const LatticeMesh cored =
      triangulateWith(squarePslg(), layLattices(mesh, {.size_max = 0.02, .most_places = 100000}), true);
  ASSERT_EQ(cored.cores.size(), 1u);
  // The core ends about five spacings from each side.
  EXPECT_NEAR(static_cast<double>(cored.coreVertices()), 0.8 * 0.8 / (0.8660254 * 0.02 * 0.02), 150.0);
}

// One length in each half of a square, and another in the band between, which neither half's lattice suits.
class TwoLengths final : public SizeFunction {
 public:
  double at(const Point& p) const override { return p.x < 0.45 ? 0.01 : p.x > 0.55 ? 0.02 : 0.014; }
  double least() const override { return 0.01; }
  double most() const override { return 0.02; }
};

TEST(LayLattices, GivesEachLengthItsOwn) {
  const TriMesh mesh = constrainedDelaunay(squarePslg());
  const TwoLengths size;
  const std::vector<LatticePlaces> found = layLattices(mesh, {.size = &size, .most_places = 1000000});
  ASSERT_GE(found.size(), 2u);
  double nearest = 1.0;
  for (const LatticePlaces& some : found) {
    const std::vector<Point> points = pointsOf(some);
    EXPECT_GE(points.size(), 100u);
    for (const Point& p : points) {
      EXPECT_NEAR(size.at(p), some.lattice.spacing, 0.13 * some.lattice.spacing);
      for (const LatticePlaces& other : found)
        if (&other != &some)
          for (const Point& q : pointsOf(other))
            nearest = std::min(nearest, distance(p, q) / std::max(some.lattice.spacing, other.lattice.spacing));
    }
    // At least 90 % of the lattice that fits into the left half without its margins.
    if (some.lattice.spacing == 0.01) {
      EXPECT_GT(points.size(), 0.9 * 0.43 / (0.8660254 * 1e-4));
    }
  }
  EXPECT_GT(nearest, 0.8);
}

// Segments and points in all parts: a lattice has the places that are inside, where its length is requested here and at
// all neighbours, and that are two spacings from the input. Each place is checked separately.
TEST(LayLattices, TakesOfEachLengthWhatIsClear) {
  constexpr std::array<std::pair<std::int64_t, std::int64_t>, 7> kAround{
      {{0, 0}, {1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, -1}, {-1, 1}}};
  Pslg pslg = squarePslg();
  const auto addLine = [&pslg](const Point& p, const Point& q) {
    const auto first = static_cast<VertexId>(pslg.points.size());
    pslg.points.insert(pslg.points.end(), {p, q});
    pslg.segments.push_back({first, first + 1});
  };
  addLine({0.1, 0.12}, {0.37, 0.2});
  addLine({0.3, 0.61}, {0.9, 0.57});
  addLine({0.71, 0.9}, {0.73, 0.72});
  addLine({0.449, 0.3}, {0.451, 0.4});
  pslg.points.insert(pslg.points.end(), {{0.2, 0.8}, {0.8, 0.2}, {0.5, 0.8}});
  const TriMesh mesh = constrainedDelaunay(pslg);
  const TwoLengths size;
  const std::vector<LatticePlaces> found = layLattices(mesh, {.size = &size, .most_places = 1000000});
  ASSERT_GE(found.size(), 2u);
  for (const auto& [lattice, places] : found) {
    const double spacing = lattice.spacing;
    const auto isRequested = [&](std::int64_t a, std::int64_t b) {
      const Point p = lattice.at(a, b);
      return !isInside(mesh, p) || size.at(p) == spacing;
    };
    std::set<std::pair<std::int64_t, std::int64_t>> taken;
    for (const LatticePlace& p : placesIn(places)) taken.insert({p.a, p.b});
    for (std::int64_t b = 0; b < 120; ++b) {
      for (std::int64_t a = -60; a < 105; ++a) {
        const Point p = lattice.at(a, b);
        const double clear = distanceToInput(pslg, mesh, p);
        if (std::abs(clear - 2.0 * spacing) < 1e-9 * spacing) continue;  // rounding decides
        const bool expected =
            clear > 2.0 * spacing && isInside(mesh, p) &&
            std::ranges::all_of(kAround, [&](const auto& by) { return isRequested(a + by.first, b + by.second); });
        EXPECT_EQ(taken.contains({a, b}), expected) << spacing << ": " << p.x << " " << p.y;
      }
    }
  }
}

TEST(LayLattices, LaysNoneWithoutLengthsOrRoom) {
  const TriMesh mesh = constrainedDelaunay(squarePslg());
  const ConstantSize size(0.01);
  EXPECT_TRUE(layLattices(mesh, {.most_places = 1000000}).empty());
  EXPECT_TRUE(layLattices(mesh, {.size = &size, .most_places = 1000}).empty());
  EXPECT_TRUE(layLattices(mesh, {.size_max = 0.5, .most_places = 1000}).empty());
}

// The sliver's sides are too long to count lattice places.
TEST(LayLattices, PassesSliversOver) {
  for (const double length : {1e9, 1e30, 1e60}) {
    Pslg sliver = squarePslg();
    for (Point& p : sliver.points) p = {p.x * length, p.y * 1000.0 / length};
    const TriMesh mesh = constrainedDelaunay(sliver);
    const ConstantSize size(1.0);
    const TwoLengths two;
    EXPECT_TRUE(layLattices(mesh, {.size = &size, .most_places = 1000000}).empty());
    EXPECT_TRUE(layLattices(mesh, {.size = &two, .most_places = 1000000000}).empty());
    EXPECT_TRUE(layLattices(mesh, {.size_max = 1.0, .most_places = 1000000}).empty());
  }
}

TEST(LayLattices, LeavesRoomUnderALongestEdge) {
  const TriMesh mesh = constrainedDelaunay(squarePslg());
  for (const double angle : {20.0, 30.0, 33.0, 37.0, 42.0}) {
    const auto found = layLattices(mesh, {.size_max = 0.02, .min_angle_deg = angle, .most_places = 100000});
    ASSERT_EQ(found.size(), 1u);
    EXPECT_LT(found.front().lattice.spacing, 0.02);
    EXPECT_GT(found.front().lattice.spacing, 0.017);
  }
}

}  // namespace
}  // namespace coastmesh
