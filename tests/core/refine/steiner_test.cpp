#include "core/refine/steiner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/predicates.hpp"
#include "core/triangulate/delaunay.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

constexpr double kNoSize = std::numeric_limits<double>::infinity();

struct Petal {
  Point p, q;  // the bad triangle's shortest edge; the triangle is to its left
  Point centre;
  double radius = 0.0;
};

Petal petalOf(const EditMesh& mesh, TriId t, unsigned apex, double angle) {
  Petal petal{mesh.corner(t, next3(apex)), mesh.corner(t, prev3(apex)), {}, 0.0};
  const Point pq = petal.q - petal.p;
  petal.radius = std::sqrt(squaredLength(pq)) / (2.0 * std::sin(angle));
  petal.centre = midpoint(petal.p, petal.q) + 0.5 / std::tan(angle) * Point{-pq.y, pq.x};
  return petal;
}

double clearanceAt(const EditMesh& mesh, const Point& x) {
  double clearance = std::numeric_limits<double>::infinity();
  for (VertexId v = 0; v < mesh.vertexSlots(); ++v) clearance = std::min(clearance, distance(x, mesh.point(v)));
  return clearance;
}

bool holdsVertex(const EditMesh& mesh, const Petal& petal) {
  for (VertexId v = 0; v < mesh.vertexSlots(); ++v)
    if (distance(mesh.point(v), petal.centre) < petal.radius * (1.0 - 1e-9)) return true;
  return false;
}

Point circumcentre(const EditMesh& mesh, TriId t) {
  return mesh.corner(t, 0) + circumcenterOffset(mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2));
}

// The largest clearance over all circumcentres in the petal and all intersections of its circle with Voronoi edges.
// REQUIRES: no constraint is visible from the petal, so that all its Voronoi edges are between two triangles.
double naiveClearance(const EditMesh& mesh, const Petal& petal) {
  double best = 0.0;
  const auto offer = [&](const Point& x) { best = std::max(best, clearanceAt(mesh, x)); };
  for (TriId t = 0; t < mesh.triangleSlots(); ++t) {
    const Point c = circumcentre(mesh, t);
    if (distance(c, petal.centre) <= petal.radius) offer(c);
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef twin = mesh.twin(edgeRef(t, i));
      if (twin == kNone || triOf(twin) < t) continue;
      const Point along = circumcentre(mesh, triOf(twin)) - c, offset = c - petal.centre;
      const double qa = squaredLength(along), qb = dot(along, offset),
                   qc = squaredLength(offset) - petal.radius * petal.radius;
      const double discriminant = qb * qb - qa * qc;
      if (qa == 0.0 || discriminant < 0.0) continue;
      for (const double root : {-std::sqrt(discriminant), std::sqrt(discriminant)}) {
        const double share = (-qb + root) / qa;
        if (share >= 0.0 && share <= 1.0) offer(c + share * along);
      }
    }
  }
  return best;
}

// True if no constrained edge comes within three radii of the petal's centre.
bool isFarFromConstraints(const EditMesh& mesh, const Petal& petal) {
  for (TriId t = 0; t < mesh.triangleSlots(); ++t)
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      if (!mesh.isConstrained(e)) continue;
      const Point a = mesh.point(mesh.origin(e)), ab = mesh.point(mesh.target(e)) - a;
      const double share = std::clamp(dot(petal.centre - a, ab) / squaredLength(ab), 0.0, 1.0);
      if (distance(a + share * ab, petal.centre) < 3.0 * petal.radius) return false;
    }
  return true;
}

struct Bad {
  TriId t;
  unsigned apex;
};

// The angle that Steiner points aim at, radians. It exceeds the bound as much as the bound exceeds the requested angle.
double placeAngle(const TriangleBound& bound) { return bound.min_angle + toRadians(1e-6); }

std::vector<Bad> badTriangles(const EditMesh& mesh, const TriangleBound& bound) {
  std::vector<Bad> bad;
  for (TriId t = 0; t < mesh.triangleSlots(); ++t)
    if (isBad(mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2), bound))
      bad.push_back({t, TriangleShape(mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)).shortest});
  return bad;
}

class SteinerAt : public ::testing::TestWithParam<double> {};

TEST_P(SteinerAt, OptimalHasTheClearanceOfTheNaiveSearch) {
  const TriangleBound bound(GetParam(), 180.0, kNoSize);
  SteinerSearch search(Algorithm::Optimal, bound, 0.0);
  int compared = 0;
  std::array<int, 4> types{};
  for (unsigned seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(::testing::Message() << "seed " << seed);
    const EditMesh mesh(constrainedDelaunay(randomPoints(seed, 120)));
    for (const auto [t, apex] : badTriangles(mesh, bound)) {
      const Petal petal = petalOf(mesh, t, apex, placeAngle(bound));
      // Refinement treats bad triangles with shorter edges first; before that, vertices may lie behind the shortest
      // edge.
      if (holdsVertex(mesh, petal) || !isFarFromConstraints(mesh, petal)) continue;
      const SteinerPoint found = search.find(mesh, t, apex);
      const double clearance = clearanceAt(mesh, found.place);
      ++compared;
      ++types[static_cast<unsigned>(found.type)];
      EXPECT_NEAR(clearance, naiveClearance(mesh, petal), 1e-9 * clearance);
      EXPECT_NEAR(std::sqrt(found.squared_clearance), clearance, 1e-9 * clearance);
      EXPECT_LE(distance(found.place, petal.centre), petal.radius * (1.0 + 1e-9));
      EXPECT_GE(
          inCircle(mesh.corner(found.near, 0), mesh.corner(found.near, 1), mesh.corner(found.near, 2), found.place), 0);
      // No point of the petal is farther from all vertices.
      for (int i = -8; i <= 8; ++i) {
        for (int j = -8; j <= 8; ++j) {
          const Point x = petal.centre + petal.radius / 8.0 * Point{1.0 * i, 1.0 * j};
          if (distance(x, petal.centre) > petal.radius) continue;
          ASSERT_LE(clearanceAt(mesh, x), clearance * (1.0 + 1e-9));
        }
      }
    }
  }
  EXPECT_GT(compared, 30);
  for (int type = 0; type < 3; ++type) EXPECT_GT(types[type], 0) << "type " << type + 1;
}

INSTANTIATE_TEST_SUITE_P(Angles, SteinerAt, ::testing::Values(15.0, 20.0, 30.0, 34.0, 38.0));

class SteinerOf : public ::testing::TestWithParam<NamedPslg> {};

// Properties that also hold with segments nearby.
TEST_P(SteinerOf, PlacesLieInThePetalOnAVoronoiEdge) {
  const TriangleBound bound(32.0, 180.0, kNoSize);
  const EditMesh mesh(constrainedDelaunay(GetParam().pslg));
  SteinerSearch optimal(Algorithm::Optimal, bound, 0.0), relocate(Algorithm::Relocate, bound, 0.0),
      offcenter(Algorithm::Offcenter, bound, 0.0), circumcenter(Algorithm::Circumcenter, bound, 0.0);
  for (const auto [t, apex] : badTriangles(mesh, bound)) {
    const Petal petal = petalOf(mesh, t, apex, placeAngle(bound));
    const Point own = circumcentre(mesh, t);
    const double length = distance(petal.p, petal.q);
    // Places are rounded as coordinates are; a needle's circumcentre is far away and ill-conditioned.
    const double grain = 1e-9 * petal.radius + 1e-15 * (std::abs(petal.p.x) + std::abs(petal.p.y));
    const double rounding = 1e-12 * squaredDistance(own, petal.p) / length + grain;

    const SteinerPoint ruppert = circumcenter.find(mesh, t, apex);
    EXPECT_EQ(ruppert.type, SteinerType::OwnCircumcenter);
    EXPECT_LE(distance(ruppert.place, own), rounding);
    EXPECT_EQ(ruppert.near, t);

    // The off-centre is the circumcentre, or sees the shortest edge under the target angle.
    const SteinerPoint off = offcenter.find(mesh, t, apex);
    EXPECT_LE(distance(off.place, petal.centre), petal.radius + grain);
    EXPECT_NEAR(distance(off.place, petal.p), distance(off.place, petal.q), grain);
    if (off.type == SteinerType::DualOfShortestEdge) {
      EXPECT_NEAR(angleAt(off.place, petal.p, petal.q), placeAngle(bound), 2.0 * grain / length);
    } else {
      EXPECT_EQ(off.type, SteinerType::OwnCircumcenter);
      EXPECT_LE(distance(off.place, own), rounding);
    }

    const SteinerPoint best = optimal.find(mesh, t, apex);
    EXPECT_LE(distance(best.place, petal.centre), petal.radius + grain);
    EXPECT_GE(best.squared_clearance, off.squared_clearance * (1.0 - 1e-12));
    ASSERT_LT(best.near, mesh.triangleSlots());
    // Equidistant from the three corners of the triangle nearby, or from the two of a Voronoi edge.
    std::vector<double> to_corners;
    for (unsigned i = 0; i < 3; ++i) to_corners.push_back(distance(best.place, mesh.corner(best.near, i)));
    std::ranges::sort(to_corners);
    EXPECT_NEAR(to_corners[0], to_corners[1], 1e-7 * to_corners[1] + rounding);
    EXPECT_TRUE(best.type != SteinerType::OtherCircumcenter || best.near != t);

    const SteinerPoint same = relocate.find(mesh, t, apex);
    EXPECT_EQ(same.place, best.place);
    EXPECT_EQ(same.type, best.type);
  }
}

INSTANTIATE_TEST_SUITE_P(All, SteinerOf, ::testing::ValuesIn(assortedPslgs()),
                         [](const auto& param_info) { return nameOf(param_info.param); });

TEST(Steiner, AimingHigherMovesTheOffcenterInwards) {
  // A needle over a short edge.
  Pslg pslg;
  pslg.points = {{0, 0}, {1, 0}, {0.5, 20}};
  const EditMesh mesh(constrainedDelaunay(pslg));
  const TriangleBound bound(30.0, 180.0, kNoSize);
  const unsigned apex = mesh.cornerOf(0, 2);
  double before = std::numeric_limits<double>::infinity();
  for (const double aim_deg : {0.0, 1.0, 5.0}) {
    const SteinerPoint point = SteinerSearch(Algorithm::Optimal, bound, toRadians(aim_deg)).find(mesh, 0, apex);
    EXPECT_EQ(point.type, SteinerType::DualOfShortestEdge);
    EXPECT_NEAR(toDegrees(angleAt(point.place, {0, 0}, {1, 0})), 30.0 + aim_deg, 1e-5);
    EXPECT_LT(point.place.y, before);
    before = point.place.y;
  }
}

TEST(Steiner, BadForItsSizeAlone) {
  // Good angles, edges of about 1, and half of that as the maximum size.
  Pslg pslg;
  pslg.points = {{0, 0}, {1, 0}, {0.5, 0.9}};
  const EditMesh mesh(constrainedDelaunay(pslg));
  const TriangleBound bound(30.0, 180.0, 0.5);
  for (const Algorithm algorithm : {Algorithm::Offcenter, Algorithm::Optimal, Algorithm::Relocate}) {
    const unsigned apex = TriangleShape(mesh.corner(0, 0), mesh.corner(0, 1), mesh.corner(0, 2)).shortest;
    const SteinerPoint point = SteinerSearch(algorithm, bound, 0.0).find(mesh, 0, apex);
    const Point p = mesh.corner(0, next3(apex)), q = mesh.corner(0, prev3(apex));
    EXPECT_NEAR(distance(point.place, p), distance(point.place, q), 1e-12);
    EXPECT_GT(clearanceAt(mesh, point.place), 0.25);
    EXPECT_LT(clearanceAt(mesh, point.place), 1.0);
  }
}

// Target lengths that grow with the distance from the edge y = 0.
class LengthFourTimesY final : public SizeFunction {
 public:
  double at(const Point& x) const override { return 4.0 * x.y; }
  double least() const override { return 0.1; }
  double most() const override { return 100.0; }
};

// Beside an edge of the plane far from the origin of a sphere, a triangle that is turned over in space has no
// circumcentre to insert. Its centroid is close to the corner in the middle.
TEST(Steiner, ClearanceOfTrianglesTurnedOverInSpace) {
  const Surface sphere = Surface::sphere(1.0);
  Pslg pslg;
  pslg.points = {{-1, 20}, {1, 20}, {0.1, 20.001}};
  const EditMesh mesh(constrainedDelaunay(pslg));
  TriangleBound bound(30.0, 180.0, kNoSize);
  bound.surface = sphere;
  for (unsigned apex = 0; apex < 3; ++apex) {
    const SteinerPoint point = SteinerSearch(Algorithm::Optimal, bound, 0.0).find(mesh, 0, apex);
    double nearest = std::numeric_limits<double>::infinity();
    for (const Point& corner : pslg.points) nearest = std::min(nearest, sphere.squaredChord(point.place, corner));
    EXPECT_DOUBLE_EQ(point.squared_clearance, nearest);
  }
}

// The petal is the circumscribed disk of an equilateral triangle with the target length at the centroid of the
// equilateral triangle on the edge.
TEST(Steiner, LengthsWantedMakeThePetal) {
  Pslg pslg;
  pslg.points = {{0, 0}, {1, 0}, {0.5, 20}};
  const EditMesh mesh(constrainedDelaunay(pslg));
  const LengthFourTimesY wanted;
  const TriangleBound bound(30.0, 180.0, kNoSize, &wanted, 1.4);
  const unsigned apex = mesh.cornerOf(0, 2);
  const double length = 4.0 * std::sqrt(3.0) / 6.0;
  const auto tip = [](double radius) { return radius + std::sqrt(radius * radius - 0.25); };
  const SteinerPoint point = SteinerSearch(Algorithm::Optimal, bound, 0.0).find(mesh, 0, apex);
  EXPECT_EQ(point.type, SteinerType::DualOfShortestEdge);
  EXPECT_NEAR(point.place.x, 0.5, 1e-12);
  EXPECT_NEAR(point.place.y, tip(length / std::sqrt(3.0)), 1e-9);
  EXPECT_NEAR(point.squared_clearance, squaredLength(point.place), 1e-9);
  const SteinerPoint longer = SteinerSearch(Algorithm::Optimal, bound, 0.0, 1.2).find(mesh, 0, apex);
  EXPECT_NEAR(longer.place.y, tip(1.2 * length / std::sqrt(3.0)), 1e-9);
}

// A long target length does not make the petal larger than the angle does; a short one leaves room for the edge.
TEST(Steiner, PetalsHaveRoomForTheirEdge) {
  Pslg pslg;
  pslg.points = {{0, 0}, {1, 0}, {0.5, 20}};
  const EditMesh mesh(constrainedDelaunay(pslg));
  const unsigned apex = mesh.cornerOf(0, 2);
  for (const double length : {0.01, 100.0}) {
    const ConstantSize wanted(length);
    const TriangleBound bound(30.0, 180.0, kNoSize, &wanted, 1.4);
    const SteinerPoint point = SteinerSearch(Algorithm::Offcenter, bound, 0.0).find(mesh, 0, apex);
    EXPECT_NEAR(point.place.y, length < 1.0 ? 0.5 : 1.0 + std::sqrt(0.75), 1e-5);
  }
}

// On a sphere so large that it is flat here, as in the plane; also away from the origin.
TEST(Steiner, OnASphere) {
  for (const Point& away : {Point{0, 0}, Point{500, 200}}) {
    Pslg pslg;
    pslg.points = {away + Point{0, 0}, away + Point{1, 0}, away + Point{0.5, 20}};
    const EditMesh mesh(constrainedDelaunay(pslg));
    const TriangleBound flat(30.0, 180.0, kNoSize);
    TriangleBound curved = flat;
    curved.surface = Surface::sphere(1e5);
    const unsigned apex = mesh.cornerOf(0, 2);
    for (const Algorithm algorithm : {Algorithm::Circumcenter, Algorithm::Offcenter, Algorithm::Optimal}) {
      const SteinerPoint expected = SteinerSearch(algorithm, flat, 0.0).find(mesh, 0, apex);
      const SteinerPoint point = SteinerSearch(algorithm, curved, 0.0).find(mesh, 0, apex);
      EXPECT_EQ(point.type, expected.type);
      EXPECT_NEAR(distance(point.place, expected.place), 0.0, 1e-3);
      EXPECT_NEAR(point.squared_clearance, expected.squared_clearance, 1e-2 * expected.squared_clearance);
    }
  }
}

// Anywhere on a sphere, the off-centre sees its edge under the target angle, measured between chords in space. The
// angle exceeds the bound by at least the surface's margin times the clearance.
TEST(Steiner, OffcentresOnASphereSeeTheirEdgeUnderTheAngle) {
  for (const Point& away : {Point{0, 0}, Point{3, 1}, Point{-8, 4}}) {
    for (const double margin : {0.0, 0.02}) {
      const Surface surface = Surface::sphere(5.0, margin);
      const Frame frame(surface, away);
      Pslg pslg;  // a needle in the frame there
      pslg.points = {frame.from({0, 0}), frame.from({0.8, 0}), frame.from({0.4, 4})};
      const EditMesh mesh(constrainedDelaunay(pslg));
      const unsigned apex = mesh.cornerOf(0, 2);
      TriangleBound bound(30.0, 180.0, kNoSize);
      bound.surface = surface;
      const SteinerPoint point = SteinerSearch(Algorithm::Offcenter, bound, 0.0).find(mesh, 0, apex);
      EXPECT_EQ(point.type, SteinerType::DualOfShortestEdge);
      const Point &p = pslg.points[0], &q = pslg.points[1];
      EXPECT_NEAR(point.squared_clearance, surface.squaredChord(point.place, p), 1e-9);
      EXPECT_NEAR(point.squared_clearance, surface.squaredChord(point.place, q), 0.01 * point.squared_clearance);
      const double angle = std::acos(TriangleShape(p, q, point.place, surface).cosAt(2));
      const double room = margin * std::sqrt(point.squared_clearance);
      EXPECT_FALSE(isBad(p, q, point.place, bound));
      EXPECT_GE(angle, toRadians(30.0) + room);
      EXPECT_LE(angle, toRadians(30.0) + 1e-4 + 1.5 * room);
    }
  }
}

// Random points on a sphere so large that it is flat there: each Steiner point is that of the plane.
TEST(Steiner, WhereASphereIsFlatAsInThePlane) {
  const TriangleBound flat(30.0, 180.0, kNoSize);
  TriangleBound curved = flat;
  const EditMesh mesh(constrainedDelaunay(randomPoints(3, 120)));
  double extent = 0.0;
  for (VertexId v = 0; v < mesh.vertexSlots(); ++v) extent = std::max(extent, distance({}, mesh.point(v)));
  curved.surface = Surface::sphere(1e6 * extent);
  SteinerSearch in_plane(Algorithm::Optimal, flat, 0.0), on_sphere(Algorithm::Optimal, curved, 0.0);
  int compared = 0;
  for (const auto [t, apex] : badTriangles(mesh, flat)) {
    const SteinerPoint expected = in_plane.find(mesh, t, apex), found = on_sphere.find(mesh, t, apex);
    EXPECT_NEAR(found.squared_clearance, expected.squared_clearance, 1e-4 * expected.squared_clearance);
    const double clearance = std::sqrt(expected.squared_clearance);
    EXPECT_LE(clearanceAt(mesh, found.place), clearance * (1.0 + 1e-4));
    if (found.type == expected.type) {
      EXPECT_LE(distance(found.place, expected.place), 1e-3 * clearance);
    }
    ++compared;
  }
  EXPECT_GT(compared, 10);
}

}  // namespace
}  // namespace coastmesh
