#include "core/input_corners.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "core/refine/mend_triangles.hpp"
#include "core/refine/refine.hpp"
#include "core/refine/vertex_notes.hpp"
#include "core/triangulate/delaunay.hpp"
#include "tests/support/excused_twin.hpp"
#include "tests/support/item_loops.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

constexpr double kNoSize = std::numeric_limits<double>::infinity();

std::array<Point, 3> cornersOf(const TriMesh& mesh, TriId t) {
  const auto& v = mesh.triangles[t].v;
  return {mesh.points[v[0]], mesh.points[v[1]], mesh.points[v[2]]};
}

std::vector<std::array<double, 7>> figuresOf(const InputCorners& corners) {
  std::vector<std::array<double, 7>> figures;
  for (const InputCorner& c : corners.all())
    figures.push_back({c.apex.x, c.apex.y, c.right.x, c.right.y, c.left.x, c.left.y, c.radius});
  std::ranges::sort(figures);
  return figures;
}

// A box with a wedge of 20 degrees at its centre, the sides 1 and 1.5 long; optionally an isolated point 0.4 from the
// apex.
Pslg wedgeInABox(bool with_point) {
  const double at = toRadians(20.0);
  Pslg pslg;
  pslg.points = {{-3, -3}, {3, -3}, {3, 3}, {-3, 3}, {0, 0}, {1, 0}, {1.5 * std::cos(at), 1.5 * std::sin(at)}};
  pslg.segments = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {4, 6}};
  if (with_point) pslg.points.push_back({-0.4, 0});
  return pslg;
}

TEST(InputCorners, NoneWhereInputAnglesAreLarge) {
  for (const Pslg& pslg : {squarePslg(), squareWithHole(), randomPointsInBox(2, 30), collinearRuns()})
    for (const double angle : {20.0, 33.0, 44.0})
      EXPECT_TRUE(InputCorners(constrainedDelaunay(pslg), TriangleBound(angle, 180.0, kNoSize)).all().empty());
}

TEST(InputCorners, RadiusIsTheLocalFeatureSize) {
  const TriangleBound bound(30.0, 180.0, kNoSize);
  for (const bool with_point : {false, true}) {
    const Pslg pslg = wedgeInABox(with_point);
    const InputCorners corners(constrainedDelaunay(pslg), bound);
    ASSERT_EQ(corners.all().size(), 1u);
    EXPECT_EQ(corners.all()[0].apex, pslg.points[4]);
    EXPECT_EQ(corners.all()[0].right, pslg.points[5]);
    EXPECT_EQ(corners.all()[0].left, pslg.points[6]);
    EXPECT_NEAR(corners.all()[0].radius, with_point ? 0.4 : 1.0, 1e-8);
  }
  EXPECT_TRUE(InputCorners(constrainedDelaunay(wedgeInABox(false)), TriangleBound(19.9, 180.0, kNoSize)).all().empty());
}

TEST(InputCorners, ASegmentThatPassesByCounts) {
  Pslg pslg = wedgeInABox(false);
  pslg.points.insert(pslg.points.end(), {{-0.3, -2}, {-0.3, 2}});
  pslg.segments.push_back({7, 8});
  const InputCorners corners(constrainedDelaunay(pslg), TriangleBound(30.0, 180.0, kNoSize));
  ASSERT_EQ(corners.all().size(), 1u);
  EXPECT_NEAR(corners.all()[0].radius, 0.3, 1e-8);
}

// Many corners are found by a tree, few by a scan, and by threads in any order.
TEST(InputCorners, ManyAreAsTheFewAre) {
  const TriangleBound bound(30.0, 180.0, kNoSize);
  for (const std::size_t count : {1u, 15u, 16u, 40u}) {
    Pslg all;
    for (std::size_t i = 0; i < count; ++i) {
      const auto first = static_cast<VertexId>(all.points.size());
      const Pslg one = wedgeInABox(i % 2 == 0);
      for (const Point& p : one.points) all.points.push_back(p + Point{8.0 * static_cast<double>(i), 0.0});
      for (const Segment& s : one.segments) all.segments.push_back({first + s.a, first + s.b});
    }
    const TriMesh mesh = constrainedDelaunay(all);
    const InputCorners corners(mesh, bound);
    ASSERT_EQ(corners.all().size(), count);
    for (const InputCorner& corner : corners.all()) {
      const auto box = static_cast<int>(std::lround(corner.apex.x / 8.0));
      EXPECT_NEAR(corner.radius, box % 2 == 0 ? 0.4 : 1.0, 1e-8) << count;
    }
    EXPECT_EQ(figuresOf(InputCorners(mesh, bound, testing::backwards)), figuresOf(corners));
  }
}

TEST(InputCorners, ExcuseByRule) {
  const InputCorners corners(constrainedDelaunay(wedgeInABox(false)), TriangleBound(30.0, 180.0, kNoSize));
  const Point apex{0, 0};
  const auto at = [](double radius, double deg) {
    return Point{radius * std::cos(toRadians(deg)), radius * std::sin(toRadians(deg))};
  };
  EXPECT_EQ(corners.excuseOf(apex, at(1, 0), at(1.5, 20)), Excuse::Corner) << "fills it, as far as it goes";
  EXPECT_EQ(corners.excuseOf(at(0.2, 3), apex, at(0.1, 1)), Excuse::Corner) << "a part of it";
  EXPECT_EQ(corners.excuseOf(at(0.5, 0), at(0.9, 1), at(0.9, 18)), Excuse::Near);
  EXPECT_EQ(corners.excuseOf(apex, at(0.9, 150), at(0.9, 160)), Excuse::Near);
  EXPECT_EQ(corners.excuseOf(apex, at(0.9, 150), at(1.1, 160)), Excuse::None) << "one vertex is too far";
  EXPECT_EQ(corners.excuseOf(at(1, 0), at(1.5, 20), at(1.5, 10)), Excuse::None);
  EXPECT_EQ(corners.excuseOf(at(2, 0), at(2, 5), at(2.2, 3)), Excuse::None);
  EXPECT_EQ(InputCorners().excuseOf(apex, at(1, 0), at(1.5, 20)), Excuse::None);
}

TEST(InputCorners, LargestAngleAloneMayMakeOne) {
  // A corner of 85 degrees cannot be divided into angles of 43 to 81.
  const double at = toRadians(85.0);
  Pslg pslg;
  pslg.points = {{0, 0}, {1, 0}, {1 + std::cos(at), std::sin(at)}, {std::cos(at), std::sin(at)}};
  for (VertexId i = 0; i < 4; ++i) pslg.segments.push_back({i, (i + 1) % 4});
  const TriMesh mesh = constrainedDelaunay(pslg);
  const auto count = [&](double low, double high) {
    return InputCorners(mesh, TriangleBound(low, high, kNoSize)).all().size();
  };
  EXPECT_EQ(count(43.0, 81.0), 2u);
  EXPECT_EQ(count(42.0, 84.5), 0u);
  EXPECT_EQ(count(43.0, 94.0), 0u);
  EXPECT_EQ(count(40.0, 180.0), 0u);
}

class InputCornersOf : public ::testing::TestWithParam<NamedPslg> {};

// Bit for bit: corners depend neither on the mesh nor on rounding in refinement.
TEST_P(InputCornersOf, AreTheSameBeforeAndAfterRefinement) {
  for (const double angle : {20.0, 33.0, 45.0}) {
    for (const double largest : {180.0, 95.0}) {
      const TriangleBound bound(angle, largest, kNoSize);
      TriMesh mesh = constrainedDelaunay(GetParam().pslg);
      const auto before = figuresOf(InputCorners(mesh, bound));
      EXPECT_EQ(figuresOf(InputCorners(mesh, bound, testing::backwards)), before);
      refine(mesh, GetParam().pslg, {.min_angle_deg = angle, .max_angle_deg = largest, .max_vertices = 3000});
      EXPECT_EQ(figuresOf(InputCorners(mesh, bound)), before) << angle << " to " << largest;
    }
  }
}

TEST_P(InputCornersOf, ExcuseWhatTheTwinExcuses) {
  for (const double angle : {20.0, 33.0, 42.0}) {
    for (const Algorithm algorithm : {Algorithm::Circumcenter, Algorithm::Relocate}) {
      TriMesh mesh = constrainedDelaunay(GetParam().pslg);
      refine(mesh, GetParam().pslg, {.min_angle_deg = angle, .algorithm = algorithm, .max_vertices = 3000});
      const InputCorners corners(mesh, TriangleBound(angle, 180.0, kNoSize));
      const ExcusedTwin twin(mesh, GetParam().pslg, angle, 180.0);
      EXPECT_EQ(corners.all().size(), twin.corners());
      // Includes good triangles, which give more cases.
      for (TriId t = 0; t < mesh.triangles.size(); ++t) {
        const auto [a, b, c] = cornersOf(mesh, t);
        EXPECT_EQ(corners.excuseOf(a, b, c), twin.excuseOf(t)) << "triangle " << t << ", " << angle << " degrees";
      }
    }
  }
}

// A mesh read from a file has no input vertices. Its corners are still found if the input bends at each of them.
TEST_P(InputCornersOf, AreFoundInAMeshFromAFile) {
  const TriangleBound bound(33.0, 180.0, kNoSize);
  TriMesh mesh = constrainedDelaunay(GetParam().pslg);
  refine(mesh, GetParam().pslg, {.min_angle_deg = 33.0, .max_vertices = 3000});
  const InputCorners known(mesh, bound);
  mesh.input_vertices = 0;
  const InputCorners found(mesh, bound);
  ASSERT_EQ(found.all().size(), known.all().size());
  for (std::size_t k = 0; k < known.all().size(); ++k) {
    EXPECT_EQ(found.all()[k].apex, known.all()[k].apex);
    // Vertices of straight chains and isolated points are not recognised, so the radius can only be larger.
    EXPECT_GE(found.all()[k].radius, known.all()[k].radius * (1.0 - 1e-9));
  }
}

// A run judges triangles as the list of unresolved ones does: on the whole mesh, with the notes that pieces and patches
// carry.
TEST_P(InputCornersOf, TheRunJudgesByThem) {
  const Pslg& pslg = GetParam().pslg;
  const RefineOptions options{.min_angle_deg = 42.0, .max_vertices = 3000};
  TriMesh mesh = constrainedDelaunay(pslg);
  const VertexNotes notes = noteInput(mesh, boundOf(options));
  const RefineStats stats = refine(mesh, pslg, options);
  std::set<std::pair<double, double>> listed, violating;
  for (const BoundViolation& s : stats.unresolved) listed.emplace(s.place.x, s.place.y);
  VertexNotes own = notes;
  own.spacing.resize(mesh.points.size(), 1.0);
  const RefineRun run(TriMesh(mesh), pslg, options, std::move(own), usualVariant(options));
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = cornersOf(mesh, t);
    const Point centre = (1.0 / 3.0) * (a + b + c);
    if (violatesBound(run, t)) violating.emplace(centre.x, centre.y);
  }
  EXPECT_EQ(violating, listed);
}

INSTANTIATE_TEST_SUITE_P(All, InputCornersOf, ::testing::ValuesIn(assortedPslgs()),
                         [](const auto& param_info) { return nameOf(param_info.param); });

}  // namespace
}  // namespace coastmesh
