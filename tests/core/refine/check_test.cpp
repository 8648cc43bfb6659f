#include "core/refine/check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>

#include "core/metric.hpp"
#include "core/refine/refine.hpp"
#include "core/triangulate/delaunay.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

// A refined mesh for tests to damage.
struct Sample {
  Pslg pslg;
  TriMesh mesh;
};

Sample sampleOf(const Pslg& pslg) {
  Sample sample{pslg, constrainedDelaunay(pslg)};
  refine(sample.mesh, pslg, {.min_angle_deg = 30.0});
  return sample;
}

std::set<DefectKind> kindsIn(const std::vector<MeshDefect>& defects) {
  std::set<DefectKind> kinds;
  for (const MeshDefect& d : defects) kinds.insert(d.kind);
  return kinds;
}

std::set<DefectKind> kindsIn(const Sample& sample, const CheckOptions& options = {}) {
  return kindsIn(checkMesh(sample.mesh, &sample.pslg, options));
}

using Kinds = std::set<DefectKind>;

// The mesh as read from a file, which has coordinates and corners only: all links are rebuilt. Steiner points are
// rounded to multiples of `rounding`.
TriMesh asRead(const TriMesh& mesh, double rounding) {
  std::vector<Point> points(mesh.points.begin(), mesh.points.end());
  if (rounding > 0.0)
    for (std::size_t v = mesh.input_vertices; v < points.size(); ++v)
      points[v] = {std::round(points[v].x / rounding) * rounding, std::round(points[v].y / rounding) * rounding};
  std::vector<std::array<VertexId, 3>> corners;
  for (const Triangle& t : mesh.triangles) corners.push_back(t.v);
  return meshOf(std::move(points), corners);
}

VertexId firstFree(const TriMesh& mesh) {
  std::vector<bool> on_segment(mesh.points.size(), false);
  for (const Triangle& t : mesh.triangles)
    for (unsigned i = 0; i < 3; ++i)
      if (t.seg[i] != kNone) on_segment[t.v[next3(i)]] = on_segment[t.v[prev3(i)]] = true;
  for (VertexId v = mesh.input_vertices; v < mesh.points.size(); ++v)
    if (!on_segment[v]) return v;
  return kNone;
}

VertexId firstOnSegment(const TriMesh& mesh) {
  for (const Triangle& t : mesh.triangles)
    for (unsigned i = 0; i < 3; ++i)
      if (t.seg[i] != kNone && t.v[next3(i)] >= mesh.input_vertices) return t.v[next3(i)];
  return kNone;
}

EdgeRef firstInnerEdge(const TriMesh& mesh) {
  for (TriId t = 0; t < mesh.triangles.size(); ++t)
    for (unsigned i = 0; i < 3; ++i)
      if (mesh.triangles[t].adj[i] != kNone && mesh.triangles[t].seg[i] == kNone) return edgeRef(t, i);
  return kNone;
}

TEST(CheckMesh, EveryKindHasAName) {
  std::set<std::string_view> names;
  for (const DefectKind kind : {DefectKind::BrokenTopology, DefectKind::NotCounterClockwise, DefectKind::PinchedVertex,
                                DefectKind::MissingVertex, DefectKind::MissingSegment, DefectKind::NotDelaunay,
                                DefectKind::AngleBelowBound, DefectKind::WrongArea, DefectKind::UnusedVertex})
    EXPECT_TRUE(names.insert(toString(kind)).second && !toString(kind).empty());
}

TEST(CheckMesh, ASoundMeshHasNoDefect) {
  for (const Pslg& pslg : {squareWithHole(), twoRegions(), openLines(), touchingHoles(), fractalCoast(2, 2, 2)}) {
    const Sample sample = sampleOf(pslg);
    EXPECT_EQ(describe(checkMesh(sample.mesh, &sample.pslg, {.min_angle_deg = 30.0})), "");
    EXPECT_EQ(describe(checkMesh(sample.mesh, nullptr, {.min_angle_deg = 30.0})), "");
  }
}

TEST(CheckMesh, NeighbourThatDoesNotPointBack) {
  for (const EdgeRef wrong : {EdgeRef{0}, EdgeRef{5}, edgeRef(1'000'000, 0), edgeRef(0, 0) + 3}) {
    Sample sample = sampleOf(squareWithHole());
    const EdgeRef e = firstInnerEdge(sample.mesh);
    ASSERT_NE(sample.mesh.twin(e), wrong);
    sample.mesh.triangles[triOf(e)].adj[indexOf(e)] = wrong;
    EXPECT_EQ(kindsIn(sample), Kinds{DefectKind::BrokenTopology}) << wrong;
  }
}

TEST(CheckMesh, CornerOutOfRangeOrTwice) {
  for (const bool twice : {false, true}) {
    Sample sample = sampleOf(squareWithHole());
    auto& v = sample.mesh.triangles[3].v;
    v[1] = twice ? v[0] : static_cast<VertexId>(sample.mesh.points.size());
    const auto defects = checkMesh(sample.mesh, &sample.pslg, {});
    EXPECT_EQ(kindsIn(defects), Kinds{DefectKind::BrokenTopology});
    EXPECT_TRUE(std::ranges::any_of(defects, [](const MeshDefect& d) { return d.triangle == 3; }));
  }
}

TEST(CheckMesh, ACornerTwiceWithoutNeighbours) {
  for (unsigned i = 0; i < 3; ++i) {
    TriMesh mesh = meshOf({{0, 0}, {3, 0}, {0, 3}}, {{0, 1, 2}});
    mesh.triangles[0].v[i] = mesh.triangles[0].v[next3(i)];
    EXPECT_EQ(kindsIn(checkMesh(mesh, nullptr, {})), Kinds{DefectKind::BrokenTopology}) << i;
  }
}

// Each corner and each neighbour is damaged in turn: the defect names the triangle, or its place is that triangle's.
TEST(CheckMesh, BrokenTrianglesAreToldOneByOne) {
  const TriMesh mesh = meshOf({{0, 0}, {3, 0}, {3, 3}, {0, 3}}, {{0, 1, 2}, {0, 2, 3}});
  const auto broken = [](const TriMesh& changed) {
    std::set<TriId> triangles;
    for (const MeshDefect& d : checkMesh(changed, nullptr, {}))
      if (d.kind == DefectKind::BrokenTopology) triangles.insert(d.triangle);
    return triangles;
  };
  EXPECT_EQ(broken(mesh), std::set<TriId>{});
  for (unsigned i = 0; i < 3; ++i) {
    TriMesh same = mesh, beyond = mesh;
    same.triangles[1].v[i] = same.triangles[1].v[(i + 1) % 3];
    beyond.triangles[1].v[i] = 4;
    EXPECT_TRUE(broken(same).contains(1)) << i;
    EXPECT_TRUE(broken(beyond).contains(1)) << i;
    TriMesh without = mesh;
    const EdgeRef twin = mesh.triangles[0].adj[i];
    without.triangles[0].adj[i] = twin == kNone ? edgeRef(1, 0) : edgeRef(0, 0) + 3;
    EXPECT_TRUE(broken(without).contains(0)) << i;
  }
  // Two triangles that point to each other but do not share an edge.
  for (const VertexId corner : {0u, 2u}) {
    TriMesh other = mesh;
    other.points.push_back({-1, 1});
    *std::ranges::find(other.triangles[1].v, corner) = 4;
    EXPECT_EQ(broken(other), (std::set<TriId>{0, 1})) << corner;
  }
  TriMesh marked = mesh;
  for (unsigned i = 0; i < 3; ++i)
    if (marked.triangles[0].adj[i] != kNone) marked.triangles[0].seg[i] = 7;
  const auto defects = checkMesh(marked, nullptr, {});
  ASSERT_EQ(defects.size(), 2u);
  EXPECT_NEAR(distance(defects[0].place, {2, 1}), 0.0, 1e-12);
  EXPECT_NEAR(distance(defects[1].place, {1, 2}), 0.0, 1e-12);
}

// Rounding moves cocircular points in meshes read from files, so these get a tolerance; in our own, circles are exact.
TEST(CheckMesh, RoundingMakesNoEdgeThatIsNotDelaunay) {
  for (const double inwards : {1e-9, 1e-5}) {
    // In a square of side 2, the corner (2, 2) is moved into the circle through the others; the diagonal joins its
    // neighbours.
    const double x = 2.0 - inwards;
    TriMesh mesh = meshOf({{0, 0}, {2, 0}, {x, x}, {0, 2}}, {{0, 1, 3}, {1, 2, 3}});
    EXPECT_EQ(checkMesh(mesh, nullptr, {}).size(), inwards > 1e-7 ? 1u : 0u) << inwards;
    for (const VertexId ours : {1u, 4u}) {
      mesh.input_vertices = ours;
      EXPECT_EQ(checkMesh(mesh, nullptr, {}).size(), 1u) << inwards;
    }
  }
}

// Each edge is reported once, whichever corners of its two triangles are opposite.
TEST(CheckMesh, EachEdgeThatIsNotDelaunayOnce) {
  for (unsigned i = 0; i < 3; ++i)
    for (unsigned j = 0; j < 3; ++j) {
      std::array<VertexId, 3> first = {0, 1, 3}, second = {1, 2, 3};
      std::ranges::rotate(first, first.begin() + i);
      std::ranges::rotate(second, second.begin() + j);
      const auto defects = checkMesh(meshOf({{0, 0}, {2, 0}, {1.1, 1.1}, {0, 2}}, {first, second}), nullptr, {});
      ASSERT_EQ(defects.size(), 1u) << i << j;
      EXPECT_EQ(defects[0].triangle, 0u);
      EXPECT_EQ(defects[0].place, (Point{1.0, 1.0}));
    }
}

TEST(CheckMesh, TurnedTrianglesAreToldWhereTheyAre) {
  const TriMesh mesh = meshOf({{0, 0}, {3, 0}, {0, 6}}, {{0, 2, 1}});
  const auto defects = checkMesh(mesh, nullptr, {});
  ASSERT_EQ(defects.size(), 1u);
  EXPECT_EQ(defects[0].kind, DefectKind::NotCounterClockwise);
  EXPECT_NEAR(distance(defects[0].place, {1, 2}), 0.0, 1e-12);
}

TEST(CheckMesh, CountsOfBoundsStartAnew) {
  BoundCounts counts;
  const TriMesh needle = meshOf({{0, 0}, {9, 0}, {4, 1}}, {{0, 1, 2}});
  checkMesh(needle, nullptr, {.min_angle_deg = 30.0}, inOrder, &counts);
  EXPECT_GT(counts.below, 0u);
  TriMesh broken = needle;
  broken.triangles[0].v[0] = 1;
  checkMesh(broken, nullptr, {.min_angle_deg = 30.0}, inOrder, &counts);
  EXPECT_EQ(counts.below, 0u);
}

TEST(CheckMesh, SegmentKnownOnOneSideOnly) {
  Sample sample = sampleOf(twoRegions());
  bool changed = false;
  for (Triangle& t : sample.mesh.triangles)
    for (unsigned i = 0; i < 3 && !changed; ++i)
      if (t.seg[i] != kNone && t.adj[i] != kNone) {
        t.seg[i] = kNone;
        changed = true;
      }
  ASSERT_TRUE(changed);
  EXPECT_EQ(kindsIn(sample), Kinds{DefectKind::BrokenTopology});
}

TEST(CheckMesh, TurnedTriangle) {
  Sample sample = sampleOf(fractalCoast(2, 2, 2));
  const VertexId v = firstFree(sample.mesh);
  ASSERT_NE(v, kNone);
  // Moves v across the opposite edge of one of its triangles.
  for (TriId t = 0; t < sample.mesh.triangles.size(); ++t) {
    const auto& c = sample.mesh.triangles[t].v;
    if (std::ranges::find(c, v) == c.end()) continue;
    const Point centre = (1.0 / 3.0) * (sample.mesh.points[c[0]] + sample.mesh.points[c[1]] + sample.mesh.points[c[2]]);
    sample.mesh.points[v] = centre + 3.0 * (centre - sample.mesh.points[v]);
    break;
  }
  EXPECT_TRUE(kindsIn(sample).contains(DefectKind::NotCounterClockwise));
}

TEST(CheckMesh, FlatTriangle) {
  const TriMesh mesh = meshOf({{0, 0}, {1, 0}, {2, 0}, {1, 1}}, {{0, 1, 3}, {1, 2, 3}, {0, 2, 1}});
  const auto defects = checkMesh(mesh, nullptr, {.delaunay = false});
  ASSERT_EQ(defects.size(), 1u);
  EXPECT_EQ(defects[0].kind, DefectKind::NotCounterClockwise);
  EXPECT_EQ(defects[0].triangle, 2u);
}

TEST(CheckMesh, PinchedVertexOnlyWhereAsked) {
  const Sample sample = sampleOf(touchingHoles());
  EXPECT_EQ(kindsIn(sample), Kinds{});
  const auto defects = checkMesh(sample.mesh, &sample.pslg, {.pinches = true});
  ASSERT_EQ(defects.size(), 2u);
  for (const MeshDefect& d : defects) {
    EXPECT_EQ(d.kind, DefectKind::PinchedVertex);
    EXPECT_TRUE((d.place == Point{0.0, 0.0}) || (d.place == Point{0.5, 0.5}));
  }
  EXPECT_EQ(describe(checkMesh(sampleOf(squareWithHole()).mesh, nullptr, {.pinches = true})), "");
  const TriMesh bow_tie = meshOf({{0, 0}, {1, -1}, {1, 1}, {-1, 1}, {-1, -1}}, {{0, 1, 2}, {0, 3, 4}});
  EXPECT_EQ(kindsIn(checkMesh(bow_tie, nullptr, {.pinches = true})), Kinds{DefectKind::PinchedVertex});
}

TEST(CheckMesh, InputVertexMovedByOneBit) {
  Sample sample = sampleOf(squareWithHole());
  sample.mesh.points[2].x = std::nextafter(1.0, 2.0);
  const auto defects = checkMesh(sample.mesh, &sample.pslg, {});
  ASSERT_EQ(kindsIn(defects), Kinds{DefectKind::MissingVertex});
  EXPECT_EQ(defects.front().place, (Point{1.0, 1.0}));
}

TEST(CheckMesh, PointInsideTheDomainThatIsNoCorner) {
  // Input points without segments must also be vertices of the mesh.
  const Pslg pslg = randomPointsInBox(3, 5);
  Pslg fewer = pslg;
  fewer.points.pop_back();
  Sample sample{pslg, constrainedDelaunay(fewer)};
  sample.mesh.points.push_back(pslg.points.back());
  sample.mesh.input_vertices = static_cast<VertexId>(pslg.points.size());
  EXPECT_TRUE(kindsIn(sample).contains(DefectKind::MissingVertex));
}

TEST(CheckMesh, LabelledPointInsideTheDomainThatIsNoCorner) {
  Pslg pslg = nestedRings();
  Sample sample{pslg, constrainedDelaunay(pslg)};
  const Point lonely{0.1, 0.1};
  sample.pslg.points.push_back(lonely);
  sample.mesh.points.push_back(lonely);
  sample.mesh.input_vertices = static_cast<VertexId>(sample.pslg.points.size());
  EXPECT_TRUE(kindsIn(sample).contains(DefectKind::MissingVertex));
}

TEST(CheckMesh, SegmentThatIsNoChain) {
  // A diagonal that the mesh does not have.
  Sample sample = sampleOf(squarePslg());
  ASSERT_EQ(sample.mesh.triangles.size(), 2u);
  const EdgeRef inner = firstInnerEdge(sample.mesh);
  const VertexId p = sample.mesh.origin(inner), q = sample.mesh.target(inner);
  // The square's corners are in order, so the other diagonal joins the next ones.
  sample.pslg.segments.push_back({(p + 1) % 4, (q + 1) % 4});
  const auto defects = checkMesh(sample.mesh, &sample.pslg, {});
  ASSERT_EQ(kindsIn(defects), Kinds{DefectKind::MissingSegment});
  EXPECT_EQ(defects.front().place, (Point{0.5, 0.5}));
}

TEST(CheckMesh, SegmentWithAGap) {
  // Unmarks one of several pieces of a segment; it is on the boundary and has no other side.
  Sample sample = sampleOf(collinearRuns());
  for (TriId t = 0; t < sample.mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      const VertexId a = sample.mesh.origin(e), b = sample.mesh.target(e);
      if (sample.mesh.segment(e) == kNone || a < sample.mesh.input_vertices || b < sample.mesh.input_vertices) continue;
      sample.mesh.triangles[t].seg[i] = kNone;
      EXPECT_EQ(kindsIn(sample), Kinds{DefectKind::MissingSegment});
      return;
    }
  }
  FAIL() << "no segment has three pieces";
}

TEST(CheckMesh, VertexOffItsSegment) {
  Sample sample = sampleOf(squareWithHole());
  const VertexId v = firstOnSegment(sample.mesh);
  ASSERT_NE(v, kNone);
  sample.mesh.points[v] = sample.mesh.points[v] + Point{1e-9, 1e-9};
  EXPECT_TRUE(kindsIn(sample, {.delaunay = false}).contains(DefectKind::MissingSegment));
}

TEST(CheckMesh, EdgeThatIsNotDelaunay) {
  // A square with one corner moved inwards; `flipped` has the wrong, longer diagonal.
  const TriMesh mesh = meshOf({{0, 0}, {2, 0}, {1.1, 1.1}, {0, 2}}, {{0, 1, 2}, {0, 2, 3}});
  EXPECT_EQ(kindsIn(checkMesh(mesh, nullptr, {})), Kinds{});
  const TriMesh flipped = meshOf({{0, 0}, {2, 0}, {1.1, 1.1}, {0, 2}}, {{0, 1, 3}, {1, 2, 3}});
  const auto defects = checkMesh(flipped, nullptr, {});
  ASSERT_EQ(defects.size(), 1u);
  EXPECT_EQ(defects[0].kind, DefectKind::NotDelaunay);
  EXPECT_EQ(defects[0].place, (Point{1.0, 1.0}));
  EXPECT_EQ(kindsIn(checkMesh(flipped, nullptr, {.delaunay = false})), Kinds{});
}

// An octahedron in a stereographic projection whose pole lies in one face, which is inverted in the plane.
struct ClosedSample {
  TriMesh mesh;
  std::vector<SpacePoint> places;
};

ClosedSample octahedron(bool turned = false) {
  const SpacePoint w = (1.0 / std::sqrt(1.3 * 1.3 + 1.1 * 1.1 + 1.0)) * SpacePoint{1.3, 1.1, 1.0};
  const SpacePoint u = (1.0 / std::hypot(w.x, w.y)) * SpacePoint{-w.y, w.x, 0.0};
  const SpacePoint v = cross(u, w);  // oriented as seen from outside the sphere, opposite the pole
  ClosedSample sample;
  std::vector<Point> points;
  for (const SpacePoint& p : {SpacePoint{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}) {
    sample.places.push_back(p);
    const double shrink = 2.0 / (1.0 - dot(p, w));
    points.push_back({shrink * dot(p, u), shrink * dot(p, v)});
  }
  std::vector<std::array<VertexId, 3>> faces;
  for (const VertexId x : {0u, 1u})
    for (const VertexId y : {2u, 3u})
      for (const VertexId z : {4u, 5u}) {
        const bool even = (x + y + z) % 2 == 0;
        faces.push_back(even ? std::array<VertexId, 3>{x, y, z} : std::array<VertexId, 3>{x, z, y});
      }
  if (turned)
    for (auto& face : faces) std::swap(face[0], face[1]);
  sample.mesh = meshOf(points, faces);
  return sample;
}

TEST(CheckMesh, ClosedMeshes) {
  const ClosedSample sample = octahedron();
  CheckOptions options{.min_angle_deg = 59.999, .max_angle_deg = 60.001};
  options.places = sample.places;
  options.closed = true;
  EXPECT_EQ(describe(checkMesh(sample.mesh, nullptr, options)), "");
  options.min_angle_deg = 60.001;
  EXPECT_EQ(checkMesh(sample.mesh, nullptr, options).size(), 8u);
  options = {.places = sample.places};
  const auto open = checkMesh(sample.mesh, nullptr, options);
  EXPECT_EQ(std::ranges::count(open, DefectKind::NotCounterClockwise, &MeshDefect::kind), 1);
  const ClosedSample turned = octahedron(true);
  options.places = turned.places;
  options.closed = true;
  options.delaunay = false;
  EXPECT_EQ(checkMesh(turned.mesh, nullptr, options).size(), 8u);
}

// The same with one face divided at a point; faces in reverse order if `reversed`.
ClosedSample dividedOctahedron(const std::set<VertexId>& face, const SpacePoint& towards, bool reversed) {
  ClosedSample sample = octahedron();
  const SpacePoint w = (1.0 / std::sqrt(1.3 * 1.3 + 1.1 * 1.1 + 1.0)) * SpacePoint{1.3, 1.1, 1.0};
  const SpacePoint u = (1.0 / std::hypot(w.x, w.y)) * SpacePoint{-w.y, w.x, 0.0}, v = cross(u, w);
  const SpacePoint place = (1.0 / std::sqrt(dot(towards, towards))) * towards;
  sample.places.push_back(place);
  std::vector<Point> points(sample.mesh.points.begin(), sample.mesh.points.end());
  const double shrink = 2.0 / (1.0 - dot(place, w));
  points.push_back({shrink * dot(place, u), shrink * dot(place, v)});
  std::vector<std::array<VertexId, 3>> faces;
  for (const Triangle& t : sample.mesh.triangles) {
    if (std::set<VertexId>(t.v.begin(), t.v.end()) != face) {
      faces.push_back(t.v);
      continue;
    }
    for (unsigned i = 0; i < 3; ++i) faces.push_back({t.v[i], t.v[next3(i)], 6});
  }
  if (reversed) std::ranges::reverse(faces);
  sample.mesh = meshOf(points, faces);
  return sample;
}

// The point is near an edge, inside the circumcircle of the face beyond.
TEST(CheckMesh, ClosedMeshThatIsNotDelaunay) {
  const ClosedSample divided = dividedOctahedron({1, 3, 5}, {-1.0, -1.0, -0.2}, false);
  CheckOptions options{.places = divided.places, .closed = true};
  const auto defects = checkMesh(divided.mesh, nullptr, options);
  ASSERT_EQ(defects.size(), 1u) << describe(defects);
  EXPECT_EQ(defects[0].kind, DefectKind::NotDelaunay);
  EXPECT_EQ(defects[0].place, midpoint(divided.mesh.points[1], divided.mesh.points[3]));
  options.delaunay = false;
  EXPECT_EQ(describe(checkMesh(divided.mesh, nullptr, options)), "");
}

// The Delaunay property is not checked across an edge of the inverted face.
TEST(CheckMesh, ClosedMeshBesideThePole) {
  for (const bool reversed : {false, true}) {
    const ClosedSample divided = dividedOctahedron({1, 2, 4}, {-0.2, 1.0, 1.0}, reversed);
    EXPECT_EQ(describe(checkMesh(divided.mesh, nullptr, {.places = divided.places, .closed = true})), "") << reversed;
  }
}

TEST(CheckMesh, DelaunayOnlyWhereAsked) {
  // A square with one corner moved inwards, triangulated with the diagonal that is not Delaunay.
  Pslg pslg;
  pslg.points = {{0, 0}, {2, 0}, {1.1, 1.1}, {0, 2}};
  for (VertexId v = 0; v < 4; ++v) pslg.segments.push_back({v, (v + 1) % 4, 0, 0, kOutside});
  Sample sample{pslg, constrainedDelaunay(pslg)};
  ASSERT_EQ(kindsIn(sample), Kinds{});
  const std::vector<std::array<VertexId, 3>> other = {{0, 1, 3}, {1, 2, 3}};
  const TriMesh flipped = meshOf(pslg.points, other);
  EXPECT_EQ(kindsIn(checkMesh(flipped, &pslg, {})), Kinds{DefectKind::NotDelaunay});
  EXPECT_EQ(kindsIn(checkMesh(flipped, &pslg, {.delaunay = false})), Kinds{});
}

TEST(CheckMesh, BoundsNextToNoneAreBounds) {
  // Angles of 0.286 and 179.43 degrees at an inner vertex.
  const TriMesh flat =
      meshOf({{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 0.005}}, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
  const auto kindsWith = [&](double least, double most) {
    return kindsIn(checkMesh(flat, nullptr, {.min_angle_deg = least, .max_angle_deg = most, .delaunay = false}));
  };
  EXPECT_EQ(kindsWith(0.5, 180.0), Kinds{DefectKind::AngleBelowBound});
  EXPECT_EQ(kindsWith(0.2, 180.0), Kinds{});
  EXPECT_EQ(kindsWith(0.0, 179.2), Kinds{DefectKind::AngleBelowBound});
  EXPECT_EQ(kindsWith(0.0, 179.6), Kinds{});
  EXPECT_EQ(kindsWith(0.0, 180.0), Kinds{});
  BoundCounts counts;
  checkMesh(flat, nullptr, {.min_angle_deg = 0.5, .delaunay = false}, inOrder, &counts);
  EXPECT_EQ(counts.below, 1u);
}

TEST(CheckMesh, AngleBeyondTheBound) {
  const Sample sample = sampleOf(squareWithHole());
  EXPECT_EQ(kindsIn(sample, {.min_angle_deg = 30.0}), Kinds{});
  const TriMesh flat = meshOf({{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 0.2}}, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
  const auto small = checkMesh(flat, nullptr, {.min_angle_deg = 20.0, .delaunay = false});
  ASSERT_FALSE(small.empty());
  EXPECT_EQ(kindsIn(small), Kinds{DefectKind::AngleBelowBound});
  EXPECT_NEAR(small.front().value, toDegrees(std::atan2(0.2, 1.0)), 1e-9);
  EXPECT_EQ(kindsIn(checkMesh(flat, nullptr, {.max_angle_deg = 120.0, .delaunay = false})),
            Kinds{DefectKind::AngleBelowBound});
  EXPECT_EQ(kindsIn(checkMesh(flat, nullptr, {.min_angle_deg = 10.0, .delaunay = false})), Kinds{});
}

TEST(CheckMesh, InputAnglesExplainSmallOnes) {
  const Pslg pslg = combPolygon(3);
  const Sample sample = sampleOf(pslg);
  EXPECT_EQ(kindsIn(sample, {.min_angle_deg = 30.0}), Kinds{});
}

TEST(CheckMesh, AngleOnTheBoundIsNoDefect) {
  const double h = std::tan(toRadians(30.0));
  const TriMesh mesh = meshOf({{0, 0}, {2, 0}, {1, h}, {1, -h}}, {{0, 1, 2}, {1, 0, 3}});
  EXPECT_EQ(describe(checkMesh(mesh, nullptr, {.min_angle_deg = 30.0, .delaunay = false})), "");
}

TEST(CheckMesh, HoleThatIsMeshed) {
  // The mesh of the whole square, compared with the input that has a hole.
  Sample sample = sampleOf(squareWithHole());
  Pslg whole = sample.pslg;
  whole.holes.clear();
  sample.mesh = constrainedDelaunay(whole);
  EXPECT_EQ(kindsIn(sample), Kinds{DefectKind::WrongArea});
}

TEST(CheckMesh, TriangleThatIsMissing) {
  const Sample sample = sampleOf(nestedRings());
  std::vector<std::array<VertexId, 3>> corners;
  for (const Triangle& t : sample.mesh.triangles) corners.push_back(t.v);
  corners.pop_back();
  const auto kinds =
      kindsIn(checkMesh(meshOf({sample.mesh.points.begin(), sample.mesh.points.end()}, corners), &sample.pslg, {}));
  EXPECT_TRUE(kinds.contains(DefectKind::WrongArea));
}

TEST(CheckMesh, TriangleTwice) {
  // It overlaps others, which only the area reveals.
  Sample sample{squarePslg(), constrainedDelaunay(squarePslg())};
  const VertexId n = static_cast<VertexId>(sample.mesh.points.size());
  for (const Point& p : {Point{0.2, 0.2}, Point{0.4, 0.2}, Point{0.2, 0.4}}) sample.mesh.points.push_back(p);
  Triangle extra;
  extra.v = {n, n + 1, n + 2};
  sample.mesh.triangles.push_back(extra);
  sample.mesh.regions.push_back(0);
  const auto defects = checkMesh(sample.mesh, &sample.pslg, {});
  ASSERT_EQ(kindsIn(defects), Kinds{DefectKind::WrongArea});
  EXPECT_NEAR(defects.front().value, 0.02, 1e-12);
}

TEST(CheckMesh, SteinerPointWithoutTriangles) {
  Sample sample = sampleOf(squareWithHole());
  sample.mesh.points.push_back({0.1, 0.1});
  const auto defects = checkMesh(sample.mesh, &sample.pslg, {});
  ASSERT_EQ(defects.size(), 1u);
  EXPECT_EQ(defects[0].kind, DefectKind::UnusedVertex);
  EXPECT_EQ(defects[0].place, (Point{0.1, 0.1}));
}

TEST(CheckMesh, NoTrianglesAtAll) {
  const Pslg pslg = squarePslg();
  EXPECT_TRUE(kindsIn(checkMesh({}, &pslg, {})).contains(DefectKind::WrongArea));
  EXPECT_TRUE(checkMesh({}, nullptr, {}).empty());
}

TEST(CheckMesh, DefectsComeByKindAndThenInOrder) {
  Sample sample = sampleOf(nestedRings());
  sample.mesh.points.insert(sample.mesh.points.end(), {{0.1, 0.1}, {0.2, 0.1}});
  sample.mesh.points[0].x = -0.1;
  const auto defects = checkMesh(sample.mesh, &sample.pslg, {.min_angle_deg = 44.0});
  std::vector<DefectKind> seen;
  for (std::size_t i = 0; i < defects.size(); ++i) {
    if (seen.empty() || seen.back() != defects[i].kind) seen.push_back(defects[i].kind);
    if (i > 0 && defects[i].kind == defects[i - 1].kind && defects[i].triangle != kNone) {
      EXPECT_LT(defects[i - 1].triangle, defects[i].triangle);
    }
  }
  EXPECT_EQ(std::set(seen.begin(), seen.end()).size(), seen.size()) << "each kind in one run";
  EXPECT_GE(seen.size(), 3u);
}

// Meshes read from files: input vertices are found by their coordinates.
class CheckByPlaceOf : public ::testing::TestWithParam<NamedPslg> {};

TEST_P(CheckByPlaceOf, RoundingIsNoDefect) {
  const Sample sample = sampleOf(GetParam().pslg);
  for (const double rounding : {0.0, 1e-13, 1e-12}) {
    // If input points are 1e-9 apart, vertices are too, so rounding must be finer.
    const double share = smallestSpacing(sample.pslg) < 1e-6 ? 1e-6 : 1.0;
    const TriMesh read = asRead(sample.mesh, share * rounding);
    EXPECT_EQ(describe(checkMesh(read, &sample.pslg, {.min_angle_deg = 29.99999})), "") << "rounded to " << rounding;
  }
}

TEST_P(CheckByPlaceOf, ShuffledVerticesAndTrianglesAreTheSame) {
  const Sample sample = sampleOf(GetParam().pslg);
  std::mt19937_64 random(4);
  std::vector<VertexId> place(sample.mesh.points.size());
  for (VertexId v = 0; v < place.size(); ++v) place[v] = v;
  for (std::size_t i = place.size(); i > 1; --i) std::swap(place[i - 1], place[random() % i]);
  std::vector<Point> points(place.size());
  for (VertexId v = 0; v < place.size(); ++v) points[place[v]] = sample.mesh.points[v];
  std::vector<std::array<VertexId, 3>> corners;
  for (const Triangle& t : sample.mesh.triangles) corners.push_back({place[t.v[1]], place[t.v[2]], place[t.v[0]]});
  std::ranges::reverse(corners);
  const TriMesh read = meshOf(std::move(points), corners);
  EXPECT_EQ(describe(checkMesh(read, &sample.pslg, {})), "");
}

TEST_P(CheckByPlaceOf, MissingVertexIsFound) {
  const Sample sample = sampleOf(GetParam().pslg);
  TriMesh read = asRead(sample.mesh, 0.0);
  // An input vertex that certainly belongs to the domain: the first in the corners of the first triangle that has one.
  for (const Triangle& t : read.triangles) {
    const auto v = std::ranges::find_if(t.v, [&](VertexId c) { return c < sample.mesh.input_vertices; });
    if (v == t.v.end()) continue;
    const Point before = read.points[*v];
    read.points[*v].x = std::nextafter(before.x, 1e9);
    const auto defects = checkMesh(read, &sample.pslg, {.delaunay = false});
    ASSERT_FALSE(defects.empty());
    EXPECT_TRUE(kindsIn(defects).contains(DefectKind::MissingVertex));
    return;
  }
  FAIL() << "no input vertex has a triangle";
}

INSTANTIATE_TEST_SUITE_P(All, CheckByPlaceOf, ::testing::ValuesIn([] {
                           // RandomPoints leaves bad triangles along the hull, FanOfAngles a few at its rays.
                           std::vector<NamedPslg> chosen = assortedPslgs();
                           std::erase_if(chosen, [](const NamedPslg& n) {
                             return n.name == "RandomPoints" || n.name == "FanOfAngles";
                           });
                           return chosen;
                         }()),
                         [](const auto& param_info) { return nameOf(param_info.param); });

TEST(CheckByPlace, SegmentCutShortIsFound) {
  const Sample sample = sampleOf(squareWithHole());
  TriMesh read = asRead(sample.mesh, 0.0);
  const VertexId v = firstOnSegment(sample.mesh);
  read.points[v] = read.points[v] + Point{0.01, 0.01};
  EXPECT_TRUE(kindsIn(checkMesh(read, &sample.pslg, {.delaunay = false})).contains(DefectKind::MissingSegment));
}

TEST(CheckByPlace, MeshOfAnotherInputIsFound) {
  const Pslg pslg = squareWithHole();
  const TriMesh read = asRead(constrainedDelaunay(twoRegions()), 0.0);
  const auto kinds = kindsIn(checkMesh(read, &pslg, {}));
  EXPECT_TRUE(kinds.contains(DefectKind::MissingVertex));
  EXPECT_TRUE(kinds.contains(DefectKind::MissingSegment));
  EXPECT_TRUE(kinds.contains(DefectKind::WrongArea));
}

}  // namespace
}  // namespace coastmesh
