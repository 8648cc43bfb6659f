#include "core/edit_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <utility>

#include "core/metric.hpp"
#include "core/predicates.hpp"
#include "core/triangulate/delaunay.hpp"
#include "tests/support/item_loops.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/mesh_figures.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

// Expects a constrained Delaunay mesh of the PSLG, and consistent arrays in EditMesh.
void expectSound(const EditMesh& mesh, const Pslg& pslg) {
  const TriMesh released = releasedCopy(mesh);
  ASSERT_EQ(describe(checkMesh(released, &pslg, {})), "");

  std::vector<std::size_t> triangles_at(mesh.vertexSlots(), 0);
  for (TriId t = 0; t < mesh.triangleSlots(); ++t)
    if (mesh.isLive(t))
      for (const VertexId v : mesh.triangle(t).v) ++triangles_at[v];
  std::set<VertexId> on_segment;
  for (TriId t = 0; t < mesh.triangleSlots(); ++t)
    for (unsigned i = 0; mesh.isLive(t) && i < 3; ++i)
      if (mesh.segment(edgeRef(t, i)) != kNone)
        on_segment.insert({mesh.origin(edgeRef(t, i)), mesh.target(edgeRef(t, i))});
  std::size_t live = 0;
  std::set<std::pair<double, double>> places;
  std::vector<EdgeRef> star;
  for (VertexId v = 0; v < mesh.vertexSlots(); ++v) {
    ASSERT_TRUE(v < mesh.inputVertices() || mesh.isLiveVertex(v) == (triangles_at[v] > 0)) << "vertex " << v;
    live += v < mesh.inputVertices() || mesh.isLiveVertex(v);
    if (!mesh.isLiveVertex(v)) continue;
    places.insert({mesh.point(v).x, mesh.point(v).y});
    if (v < mesh.inputVertices()) {
      ASSERT_EQ(mesh.kind(v), VertexKind::Input);
    } else {
      ASSERT_EQ(mesh.kind(v), on_segment.contains(v) ? VertexKind::Segment : VertexKind::Free);
    }
    const Triangle& home = mesh.triangle(mesh.triangleOf(v));
    ASSERT_TRUE(std::ranges::count(home.v, v) == 1);
    ASSERT_EQ(home.v[mesh.cornerOf(mesh.triangleOf(v), v)], v);

    const StarKind kind = mesh.star(v, star);
    const bool closed = kind == StarKind::Closed;
    std::vector<EdgeRef> some;
    ASSERT_EQ(mesh.star(v, some, star.size()), kind);
    ASSERT_EQ(some, star);
    ASSERT_EQ(mesh.star(v, some, star.size() - 1), StarKind::TooMany);
    ASSERT_LT(some.size(), star.size());
    if (mesh.kind(v) == VertexKind::Free) {
      Ring ring;
      ASSERT_TRUE(mesh.ring(v, star.size(), ring));
      ASSERT_EQ(ring.corners.size(), star.size());
      for (std::size_t k = 0; k < star.size(); ++k) {
        ASSERT_EQ(ring.corners[k], mesh.origin(star[k]));
        ASSERT_EQ(ring.triangles[k], triOf(star[k]));
      }
      ASSERT_FALSE(mesh.ring(v, star.size() - 1, ring));
    }
    if (mesh.kind(v) != VertexKind::Input) {
      ASSERT_EQ(star.size(), triangles_at[v]);
    }
    for (std::size_t i = 0; i < star.size(); ++i) {
      ASSERT_EQ(mesh.apex(star[i]), v);
      ASSERT_TRUE(i == 0 || mesh.origin(star[i]) == mesh.target(star[i - 1])) << "counter-clockwise";
    }
    ASSERT_EQ(closed, mesh.target(star.back()) == mesh.origin(star.front()) && star.size() > 2);
  }
  ASSERT_EQ(live, released.points.size());
  ASSERT_EQ(mesh.vertexCount(), released.points.size());
  for (std::size_t v = 0; v < mesh.inputVertices(); ++v) ASSERT_EQ(released.points[v], pslg.points[v]);
  for (std::size_t v = mesh.inputVertices(); v < released.points.size(); ++v)
    ASSERT_TRUE(places.contains({released.points[v].x, released.points[v].y}));
}

// Applies random changes.
class Changer {
 public:
  Changer(const Pslg& pslg, unsigned seed) : pslg_(pslg), mesh_(constrainedDelaunay(pslg)), random_(seed) {}

  EditMesh& mesh() { return mesh_; }
  std::mt19937_64& random() { return random_; }

  TriId anyTriangle() {
    TriId t = kNone;
    do {
      t = static_cast<TriId>(random_() % mesh_.triangleSlots());
    } while (!mesh_.isLive(t));
    return t;
  }

  Point inside(TriId t) {
    const double u = uniform(random_, 0.05, 0.6), v = uniform(random_, 0.05, 0.3);
    return (1.0 - u - v) * mesh_.corner(t, 0) + u * mesh_.corner(t, 1) + v * mesh_.corner(t, 2);
  }

  VertexId anyOf(VertexKind kind) {
    std::vector<VertexId> all;
    for (VertexId v = 0; v < mesh_.vertexSlots(); ++v)
      if (mesh_.isLiveVertex(v) && mesh_.kind(v) == kind) all.push_back(v);
    return all.empty() ? kNone : all[random_() % all.size()];
  }

  bool insert() {
    const TriId t = anyTriangle();
    const Point x = inside(t);
    // x lies in t up to rounding. If rounding put it beyond a constraint, no triangle is found.
    const EditMesh::Place place = mesh_.locate(x, t);
    if (place.triangle == kNone || !mesh_.findCavity(x, place.triangle, patch_)) return false;
    const VertexId v = mesh_.insertInCavity(x, patch_, touched_);
    EXPECT_EQ(mesh_.kind(v), VertexKind::Free);
    EXPECT_EQ(mesh_.point(v), x);
    return true;
  }

  bool split() {
    const TriId t = anyTriangle();
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      const SegmentId s = mesh_.segment(e);
      if (s == kNone) continue;
      const Point &a = mesh_.point(mesh_.origin(e)), &b = mesh_.point(mesh_.target(e));
      const Point x = onSegment(s, a + uniform(random_, 0.2, 0.8) * (b - a));
      const VertexId v = mesh_.splitSegment(e, x, touched_);
      if (v == kNone) return false;
      EXPECT_EQ(mesh_.kind(v), VertexKind::Segment);
      EXPECT_EQ(mesh_.point(v), x);
      return true;
    }
    return false;
  }

  bool remove(bool with_neighbour) {
    const VertexId v = anyOf(VertexKind::Free);
    if (v == kNone) return false;
    std::vector<VertexId> gone{v};
    if (with_neighbour) {
      std::vector<EdgeRef> star;
      mesh_.star(v, star);
      const VertexId w = mesh_.origin(star[random_() % star.size()]);
      if (mesh_.kind(w) != VertexKind::Free) return false;
      gone.push_back(w);
    }
    if (!mesh_.gatherPatch(gone, patch_)) return false;
    std::vector<VertexId> polygon;
    for (const BoundaryEdge& r : patch_.boundary) polygon.push_back(r.a);
    std::vector<Corners> fresh;
    if (!triangulatePolygon(mesh_, polygon, fresh)) return false;
    mesh_.replace(patch_, fresh, gone, touched_);
    mesh_.restoreDelaunay(touched_);
    return true;
  }

  bool move(VertexKind kind) {
    const VertexId v = anyOf(kind);
    if (v == kNone) return false;
    std::vector<EdgeRef> star;
    mesh_.star(v, star);
    Point to = mesh_.corner(triOf(star[random_() % star.size()]), 0);
    const double share = uniform(random_, 0.1, 0.9);
    if (kind == VertexKind::Segment) {
      std::vector<VertexId> ends;
      SegmentId seg = kNone;
      for (const EdgeRef e : star) {
        for (const EdgeRef side : {edgeRef(triOf(e), prev3(indexOf(e))), edgeRef(triOf(e), next3(indexOf(e)))}) {
          if (mesh_.segment(side) == kNone) continue;
          seg = mesh_.segment(side);
          ends.push_back(mesh_.origin(side) == v ? mesh_.target(side) : mesh_.origin(side));
        }
      }
      to = onSegment(seg, mesh_.point(v) + share * (mesh_.point(ends[random_() % ends.size()]) - mesh_.point(v)));
    } else {
      to = mesh_.point(v) + share * (to - mesh_.point(v));
    }
    for (const EdgeRef e : star)
      if (orient2d(mesh_.point(mesh_.origin(e)), mesh_.point(mesh_.target(e)), to) <= 0) return false;
    mesh_.setPoint(v, to);
    for (const EdgeRef e : star) touched_.push_back(triOf(e));
    mesh_.restoreDelaunay(touched_);
    return true;
  }

  // Every triangle that is new or changed is in `touched_`.
  void expectTouched(const std::vector<Triangle>& before) {
    for (TriId t = 0; t < mesh_.triangleSlots(); ++t) {
      if (!mesh_.isLive(t) || (t < before.size() && before[t].v == mesh_.triangle(t).v)) continue;
      ASSERT_TRUE(std::ranges::find(touched_, t) != touched_.end()) << "triangle " << t << " changed unseen";
    }
    touched_.clear();
  }

  std::vector<Triangle> triangles() const {
    std::vector<Triangle> all;
    for (TriId t = 0; t < mesh_.triangleSlots(); ++t) all.push_back(mesh_.triangle(t));
    return all;
  }

 private:
  Point onSegment(SegmentId s, const Point& near) const {
    const Point &a = pslg_.points[pslg_.segments[s].a], &b = pslg_.points[pslg_.segments[s].b];
    return a + (dot(near - a, b - a) / squaredDistance(a, b)) * (b - a);
  }

  const Pslg& pslg_;
  EditMesh mesh_;
  std::mt19937_64 random_;
  std::vector<TriId> touched_;
  Patch patch_;
};

class EditMeshOf : public ::testing::TestWithParam<NamedPslg> {};

TEST_P(EditMeshOf, StaysSoundUnderRandomChanges) {
  constexpr unsigned kSeed = 20;
  Changer changer(GetParam().pslg, kSeed);
  std::map<unsigned, int> done;
  for (int step = 0; step < 240; ++step) {
    const auto before = changer.triangles();
    // More insertions than removals first, then the reverse.
    const unsigned dice = changer.random()() % 8;
    const unsigned what = dice < 4 ? (step < 120 ? dice / 2 : 2 + dice / 2) : dice - 2;
    bool changed = false;
    switch (what) {
      case 0:
        changed = changer.insert();
        break;
      case 1:
        changed = changer.split();
        break;
      case 2:
        changed = changer.remove(false);
        break;
      case 3:
        changed = changer.remove(true);
        break;
      case 4:
        changed = changer.move(VertexKind::Free);
        break;
      default:
        changed = changer.move(VertexKind::Segment);
        break;
    }
    SCOPED_TRACE(::testing::Message() << "seed " << kSeed << ", step " << step << ", operation " << what);
    ++done[changed ? what : 100 + what];
    ASSERT_NO_FATAL_FAILURE(changer.expectTouched(before));
    ASSERT_NO_FATAL_FAILURE(expectSound(changer.mesh(), GetParam().pslg));
  }
  for (unsigned what = 0; what < 6; ++what) {
    const bool needs_segments = what == 1 || what == 5;
    EXPECT_TRUE(done[what] > 0 || (needs_segments && GetParam().pslg.segments.empty())) << "operation " << what;
  }
}

TEST_P(EditMeshOf, ComesBackAsItWas) {
  // The first release sorts the triangles; another round trip changes nothing.
  const TriMesh mesh = constrainedDelaunay(GetParam().pslg);
  const TriMesh once = EditMesh(TriMesh(mesh)).release(), twice = EditMesh(TriMesh(once)).release();
  EXPECT_EQ(digestOf(twice), digestOf(once));
  EXPECT_EQ(once.points, mesh.points);
  EXPECT_EQ(once.input_vertices, mesh.input_vertices);
  std::multiset<Corners> before, after;
  const auto turned = [](Corners c) {
    std::ranges::rotate(c, std::ranges::min_element(c));
    return c;
  };
  for (const Triangle& t : mesh.triangles) before.insert(turned(t.v));
  for (const Triangle& t : once.triangles) after.insert(turned(t.v));
  EXPECT_EQ(after, before);
}

// More triangles than one thread would note, with vertices that are not of the input on the boundary and inside.
TEST(EditMesh, IsTheSameMadeOnThreads) {
  constexpr VertexId kSide = 100, kRing = 4 * kSide;
  Pslg pslg;
  for (VertexId i = 0; i < kRing; ++i) {
    const double along = static_cast<double>(i % kSide) / kSide;
    const std::array<Point, 4> on_side{{{along, 0.0}, {1.0, along}, {1.0 - along, 1.0}, {0.0, 1.0 - along}}};
    pslg.points.push_back(on_side[i / kSide]);
    pslg.segments.push_back({i, (i + 1) % kRing});
  }
  std::mt19937 random(7);
  std::uniform_real_distribution<double> inside(0.01, 0.99);
  for (int i = 0; i < 15000; ++i) pslg.points.push_back({inside(random), inside(random)});
  TriMesh mesh = constrainedDelaunay(pslg);
  mesh.input_vertices = kSide;
  const EditMesh expected{TriMesh(mesh)}, made(TriMesh(mesh), testing::backwards);
  for (VertexId v = 0; v < mesh.points.size(); ++v) {
    ASSERT_EQ(made.triangleOf(v), expected.triangleOf(v)) << v;
    ASSERT_EQ(made.trianglesRound(v), expected.trianglesRound(v)) << v;
    ASSERT_EQ(made.kind(v), expected.kind(v)) << v;
  }
}

TEST_P(EditMeshOf, LocateFindsOrNamesTheSegmentInTheWay) {
  Changer changer(GetParam().pslg, 5);
  for (int i = 0; i < 30; ++i) changer.insert();
  const EditMesh& mesh = changer.mesh();
  int found = 0, blocked = 0;
  for (int i = 0; i < 300; ++i) {
    const TriId from = changer.anyTriangle(), to = changer.anyTriangle();
    // Every tenth point lies far outside.
    const Point x = i % 10 == 0 ? Point{50.0, -40.0} : changer.inside(to);
    const EditMesh::Place place = mesh.locate(x, from);
    ASSERT_NE(place.triangle == kNone, place.blocked == kNone);
    if (place.triangle != kNone) {
      ++found;
      for (unsigned k = 0; k < 3; ++k)
        ASSERT_GE(orient2d(mesh.corner(place.triangle, next3(k)), mesh.corner(place.triangle, prev3(k)), x), 0);
    } else {
      ++blocked;
      ASSERT_TRUE(mesh.isConstrained(place.blocked));
      ASSERT_LT(orient2d(mesh.point(mesh.origin(place.blocked)), mesh.point(mesh.target(place.blocked)), x), 0);
    }
  }
  EXPECT_GT(found, 0);
  EXPECT_GE(blocked, 30);
}

TEST_P(EditMeshOf, GatherPatchGivesARimInOrder) {
  Changer changer(GetParam().pslg, 8);
  for (int i = 0; i < 60; ++i) changer.insert();
  const EditMesh& mesh = changer.mesh();
  Patch patch;
  int disks = 0;
  for (int i = 0; i < 100; ++i) {
    const VertexId v = changer.anyOf(VertexKind::Free);
    std::vector<VertexId> ring{v};
    std::vector<EdgeRef> star;
    mesh.star(v, star);
    for (const EdgeRef e : star)
      if (mesh.kind(mesh.origin(e)) == VertexKind::Free && ring.size() < 1u + static_cast<unsigned>(i % 4))
        ring.push_back(mesh.origin(e));
    if (!mesh.gatherPatch(ring, patch)) continue;
    ++disks;
    std::set<TriId> naive;
    for (TriId t = 0; t < mesh.triangleSlots(); ++t)
      if (mesh.isLive(t) &&
          std::ranges::any_of(mesh.triangle(t).v, [&](VertexId c) { return std::ranges::find(ring, c) != ring.end(); }))
        naive.insert(t);
    EXPECT_EQ(std::set<TriId>(patch.triangles.begin(), patch.triangles.end()), naive);
    EXPECT_EQ(patch.triangles.size(), naive.size());
    // A disk with k vertices inside and r on its boundary has r + 2 k - 2 triangles.
    EXPECT_EQ(patch.triangles.size(), patch.boundary.size() + 2 * ring.size() - 2);
    for (std::size_t r = 0; r < patch.boundary.size(); ++r) {
      EXPECT_EQ(patch.boundary[r].b, patch.boundary[(r + 1) % patch.boundary.size()].a);
      const EdgeRef beyond = patch.boundary[r].beyond;
      if (beyond == kNone) continue;
      EXPECT_EQ(mesh.origin(beyond), patch.boundary[r].b);
      EXPECT_EQ(mesh.target(beyond), patch.boundary[r].a);
      EXPECT_EQ(mesh.segment(beyond), patch.boundary[r].seg);
      EXPECT_FALSE(naive.contains(triOf(beyond)));
    }
  }
  EXPECT_GT(disks, 20);
}

INSTANTIATE_TEST_SUITE_P(All, EditMeshOf, ::testing::ValuesIn(assortedPslgs()),
                         [](const auto& param_info) { return nameOf(param_info.param); });

TEST(EditMesh, CavityIsEveryTriangleWhoseCircleHoldsThePoint) {
  Changer changer(randomPointsInBox(4, 150), 9);
  const EditMesh& mesh = changer.mesh();
  Patch cavity;
  for (int i = 0; i < 200; ++i) {
    const TriId t = changer.anyTriangle();
    const Point x = changer.inside(t);
    ASSERT_TRUE(mesh.findCavity(x, t, cavity));
    std::set<TriId> naive;
    for (TriId s = 0; s < mesh.triangleSlots(); ++s)
      if (mesh.isLive(s) && inCircle(mesh.corner(s, 0), mesh.corner(s, 1), mesh.corner(s, 2), x) > 0) naive.insert(s);
    EXPECT_EQ(std::set<TriId>(cavity.triangles.begin(), cavity.triangles.end()), naive);
    EXPECT_EQ(cavity.boundary.size(), cavity.triangles.size() + 2);
    for (std::size_t r = 0; r < cavity.boundary.size(); ++r)
      EXPECT_EQ(cavity.boundary[r].b, cavity.boundary[(r + 1) % cavity.boundary.size()].a);
  }
}

TEST(EditMesh, CavityStopsAtSegments) {
  // An open segment inside the square, and a point close to it.
  Pslg pslg = squarePslg();
  pslg.points.insert(pslg.points.end(), {{0.5, 0.1}, {0.5, 0.9}});
  pslg.segments.push_back({4, 5});
  EditMesh mesh(constrainedDelaunay(pslg));
  const Point x{0.45, 0.5};
  const EditMesh::Place place = mesh.locate(x, [&] {
    for (TriId t = 0;; ++t)
      if ((1.0 / 3.0 * (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2))).x < 0.4) return t;
  }());
  ASSERT_NE(place.triangle, kNone);
  Patch cavity;
  ASSERT_TRUE(mesh.findCavity(x, place.triangle, cavity));
  std::vector<TriId> touched;
  mesh.insertInCavity(x, cavity, touched);
  expectSound(mesh, pslg);
}

TEST(EditMesh, SplitSegmentLeavesTheMeshWhereATriangleWouldTurn) {
  EditMesh mesh(constrainedDelaunay(squareWithHole()));
  const std::uint64_t digest = digestOf(releasedCopy(mesh));
  std::vector<TriId> touched;
  int refused = 0;
  for (TriId t = 0; t < mesh.triangleSlots(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      if (mesh.segment(edgeRef(t, i)) == kNone) continue;
      // Far beyond the end of the segment.
      const EdgeRef e = edgeRef(t, i);
      const Point x = mesh.point(mesh.target(e)) + 5.0 * (mesh.point(mesh.target(e)) - mesh.point(mesh.origin(e)));
      EXPECT_EQ(mesh.splitSegment(e, x, touched), kNone);
      EXPECT_TRUE(touched.empty());
      ++refused;
    }
  }
  EXPECT_EQ(refused, 8);
  EXPECT_EQ(digestOf(releasedCopy(mesh)), digest);
  EXPECT_EQ(mesh.vertexCount(), 8u);
}

TEST(EditMesh, RestoreDelaunayMendsAnyTriangulation) {
  // A fan from a point above a parabola to points on it is far from Delaunay.
  std::vector<Point> points{{0.0, 2.0}};
  std::vector<Corners> fan;
  constexpr int kSteps = 40;
  for (int i = 0; i <= kSteps; ++i) {
    const double x = -1.0 + 2.0 * i / kSteps;
    points.push_back({x, x * x});
  }
  for (VertexId i = 1; i <= kSteps; ++i) fan.push_back({0, i, i + 1});
  const TriMesh flat = meshOf(points, fan);
  EditMesh mesh{TriMesh(flat)};
  std::vector<TriId> touched;
  for (TriId t = 0; t < mesh.triangleSlots(); ++t) touched.push_back(t);
  mesh.restoreDelaunay(touched);
  expectValidMesh(releasedCopy(mesh));
}

TEST(TriangulatePolygon, GivesKMinusTwoTrianglesOfTheSameArea) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(::testing::Message() << "seed " << seed);
    const Pslg pslg = starPolygon(seed, 3 + static_cast<int>(seed) % 12);
    const EditMesh mesh(constrainedDelaunay(pslg));
    std::vector<VertexId> polygon;
    for (VertexId v = 0; v < pslg.points.size(); ++v) polygon.push_back(v);
    double expected = 0.0, area = 0.0;
    for (VertexId v = 0; v < polygon.size(); ++v)
      expected += 0.5 * cross(pslg.points[v], pslg.points[(v + 1) % polygon.size()]);
    std::vector<Corners> triangles;
    ASSERT_TRUE(triangulatePolygon(mesh, polygon, triangles));
    EXPECT_EQ(triangles.size(), polygon.size() - 2);
    for (const Corners& c : triangles) {
      EXPECT_GT(orient2d(pslg.points[c[0]], pslg.points[c[1]], pslg.points[c[2]]), 0);
      area += 0.5 * cross(pslg.points[c[1]] - pslg.points[c[0]], pslg.points[c[2]] - pslg.points[c[0]]);
    }
    EXPECT_NEAR(area, expected, 1e-12);
  }
}

TEST(TriangulatePolygon, ConvexIsDelaunay) {
  std::mt19937_64 random(6);
  for (int n = 3; n < 30; ++n) {
    Pslg pslg;
    std::vector<VertexId> polygon;
    for (int i = 0; i < n; ++i) {
      const double at = toRadians(360.0 * (i + uniform(random, 0.1, 0.9)) / n);
      pslg.points.push_back({2.0 * std::cos(at), std::sin(at)});
      polygon.push_back(static_cast<VertexId>(i));
    }
    const EditMesh mesh(constrainedDelaunay(pslg));
    std::vector<Corners> triangles;
    ASSERT_TRUE(triangulatePolygon(mesh, polygon, triangles));
    EXPECT_EQ(triangles.size(), polygon.size() - 2);
    for (const Corners& c : triangles)
      for (const Point& p : pslg.points)
        EXPECT_LE(inCircle(pslg.points[c[0]], pslg.points[c[1]], pslg.points[c[2]], p), 0);
  }
}

TEST(TriangulatePolygon, TurnedPolygonIsRefused) {
  const EditMesh mesh(constrainedDelaunay(squarePslg()));
  std::vector<Corners> triangles;
  EXPECT_FALSE(triangulatePolygon(mesh, std::vector<VertexId>{3, 2, 1, 0}, triangles));
}

// Large meshes are released range by range, on several threads: as on one, in whatever order the ranges come.
TEST(EditMesh, OrderOfRangesDoesNotMatter) {
  const Pslg pslg = randomPointsInBox(3, 20'000);
  TriMesh mesh = constrainedDelaunay(pslg);
  mesh.input_vertices = 100;
  EditMesh edit(std::move(mesh));
  ASSERT_GT(edit.triangleSlots(), 4u * 8192);  // several ranges
  Patch patch;
  std::vector<Corners> fresh;
  std::vector<TriId> touched;
  for (VertexId v = edit.inputVertices(); v < edit.vertexSlots(); v += 7) {
    if (edit.kind(v) != VertexKind::Free || !edit.gatherPatch({&v, 1}, patch)) continue;
    std::vector<VertexId> polygon;
    for (const BoundaryEdge& r : patch.boundary) polygon.push_back(r.a);
    if (triangulatePolygon(edit, polygon, fresh)) edit.replace(patch, fresh, {&v, 1}, touched);
  }
  ASSERT_LT(edit.vertexCount() + 1000, edit.vertexSlots());
  EditMesh same = edit, again = edit;
  Renumbering by, by_ranges, by_last_first;
  const std::uint64_t digest = digestOf(edit.release(by, false));
  EXPECT_EQ(digestOf(same.releaseOn(inOrder, by_ranges)), digest);
  EXPECT_EQ(digestOf(again.releaseOn(testing::backwards, by_last_first)), digest);
  for (const Renumbering* other : {&by_ranges, &by_last_first}) {
    EXPECT_EQ(other->vertex, by.vertex);
    EXPECT_EQ(other->triangle, by.triangle);
  }
}

}  // namespace
}  // namespace coastmesh
