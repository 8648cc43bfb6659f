#include "core/triangulate/triangulate_points.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "core/hilbert.hpp"
#include "core/links.hpp"
#include "core/predicates.hpp"
#include "core/triangulate/insert_points.hpp"
#include "tests/support/item_loops.hpp"

namespace coastmesh {
namespace {

// The first thing wrong with a Delaunay triangulation with ghosts; empty if nothing is.
std::string wrongIn(const Triangulation& all) {
  const LinkedTriangles& mesh = all.mesh;
  if (mesh.triangles.size() != 2 * all.points.size() - 2) return "not 2 n - 2 triangles";
  if (findBrokenLink(mesh.triangles) != kNone) return "a broken link";
  std::vector<bool> seen(all.points.size(), false);
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    const auto& v = mesh.triangles[t].v;
    if (all.isGhost(t)) {
      // The hull does not turn to the right.
      const unsigned i = mesh.cornerOf(t, all.ghost);
      const EdgeRef beyond = mesh.twin(edgeRef(t, prev3(i)));
      const VertexId next = mesh.triangles[triOf(beyond)].v[prev3(indexOf(beyond))] == all.ghost
                                ? mesh.triangles[triOf(beyond)].v[next3(mesh.cornerOf(triOf(beyond), all.ghost))]
                                : mesh.apex(beyond);
      if (orient2d(all.points[v[prev3(i)]], all.points[v[next3(i)]], all.points[next]) < 0) return "a concave hull";
      continue;
    }
    if (orient2d(all.points[v[0]], all.points[v[1]], all.points[v[2]]) <= 0) return "a triangle turned over";
    for (unsigned i = 0; i < 3; ++i) {
      seen[v[i]] = true;
      const EdgeRef beyond = mesh.twin(edgeRef(t, i));
      if (all.isGhost(triOf(beyond))) continue;
      const Point& apex = all.points[mesh.apex(beyond)];
      if (inCircle(all.points[v[0]], all.points[v[1]], all.points[v[2]], apex) > 0) return "an edge not Delaunay";
    }
  }
  if (std::ranges::count(seen, false) > 0) return "a point without triangles";
  for (VertexId v = 0; v < all.ghost; ++v) {
    const TriId t = all.triangle_of[v];
    if (std::ranges::find(mesh.triangles[t].v, v) == mesh.triangles[t].v.end()) return "a wrong triangle of a vertex";
  }
  return "";
}

std::vector<std::array<VertexId, 3>> sortedTriangles(const Triangulation& all) {
  std::vector<std::array<VertexId, 3>> triangles;
  for (const Triangle& t : all.mesh.triangles) {
    std::array<VertexId, 3> v = t.v;
    std::ranges::rotate(v, std::ranges::min_element(v));
    triangles.push_back(v);
  }
  std::ranges::sort(triangles);
  return triangles;
}

Triangulation insertedOneByOne(std::span<const Point> points) {
  Triangulation all;
  all.points = points;
  all.ghost = static_cast<VertexId>(points.size());
  all.triangle_of.resize(points.size() + 1, kNone);
  all.mesh.triangles.resize(2 * points.size());
  insertPoints(all, hilbertOrder(points), 0);
  all.mesh.triangles.resize(2 * points.size() - 2);
  return all;
}

// Enough points for at least `parts` parts.
std::vector<Point> randomPoints(std::size_t count, const std::function<Point(double, double)>& place = {}) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> from_0_to_1;
  std::vector<Point> points(count);
  for (Point& p : points) {
    const double x = from_0_to_1(random), y = from_0_to_1(random);
    p = place ? place(x, y) : Point{x, y};
  }
  return points;
}

struct Sample {
  const char* name;
  std::function<std::vector<Point>()> points;
};

void PrintTo(const Sample& sample, std::ostream* out) { *out << sample.name; }

class TriangulationOf : public ::testing::TestWithParam<Sample> {};

TEST_P(TriangulationOf, IsDelaunayWhateverTheOrderOfTheParts) {
  const std::vector<Point> points = GetParam().points();
  const Triangulation all = triangulatePoints(points);
  EXPECT_EQ(wrongIn(all), "");
  const Triangulation backwards = triangulatePoints(points, {}, testing::backwards);
  const auto corners = [](const Triangle& t) { return t.v; };
  EXPECT_TRUE(std::ranges::equal(all.mesh.triangles, backwards.mesh.triangles, {}, corners, corners));
}

std::vector<Point> latticePoints(int columns, int rows) {
  std::vector<Point> points;
  for (int x = 0; x < columns; ++x)
    for (int y = 0; y < rows; ++y) points.push_back({static_cast<double>(x), static_cast<double>(y)});
  return points;
}

std::vector<Point> onCircle(int count) {
  std::vector<Point> points;
  for (int i = 0; i < count; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / count;
    points.push_back({std::cos(angle), std::sin(angle)});
  }
  return points;
}

// Half of the points on each of two lines; parts of either alone have no triangles.
std::vector<Point> onTwoLines(Point first, Point second) {
  std::vector<Point> points;
  for (int i = 1; i <= 20000; ++i) {
    points.push_back({i * first.x, i * first.y});
    points.push_back({i * second.x, i * second.y + 0.5});
  }
  return points;
}

std::vector<Point> besideALine() {
  std::vector<Point> points;
  for (int i = 0; i < 40000; ++i) points.push_back({static_cast<double>(i), 3.0});
  points.push_back({17.5, 4.0});
  return points;
}

INSTANTIATE_TEST_SUITE_P(Points, TriangulationOf,
                         ::testing::Values(Sample{"Random", [] { return randomPoints(70000); }},
                                           Sample{"OnePartOnly", [] { return randomPoints(500); }},
                                           Sample{"Clustered",
                                                  [] {
                                                    return randomPoints(70000, [](double x, double y) {
                                                      return Point{std::pow(x, 9.0), std::pow(y, 5.0)};
                                                    });
                                                  }},
                                           Sample{"InColumns",
                                                  [] {
                                                    return randomPoints(70000, [](double x, double y) {
                                                      return Point{std::floor(8.0 * x), y};
                                                    });
                                                  }},
                                           Sample{"Lattice", [] { return latticePoints(260, 260); }},
                                           Sample{"NarrowLattice", [] { return latticePoints(3, 20000); }},
                                           Sample{"WideLattice", [] { return latticePoints(20000, 3); }},
                                           Sample{"OnACircle", [] { return onCircle(40000); }},
                                           Sample{"OnTwoLines",
                                                  [] {
                                                    return onTwoLines({1.0, 0.0}, {0.0, 1.0});
                                                  }},
                                           Sample{"OnTwoParallels",
                                                  [] {
                                                    return onTwoLines({1.0, 1.0}, {1.0, 1.0});
                                                  }},
                                           Sample{"BesideALine", [] { return besideALine(); }}),
                         [](const ::testing::TestParamInfo<Sample>& sample) { return std::string(sample.param.name); });

TEST(TriangulatePoints, OfManyPointsIsTheOneInsertedPointByPoint) {
  const std::vector<Point> points = randomPoints(70000);
  EXPECT_EQ(sortedTriangles(triangulatePoints(points)), sortedTriangles(insertedOneByOne(points)));
}

TEST(TriangulatePoints, OnOneLineHasNoTriangles) {
  std::vector<Point> points;
  for (int i = 0; i < 40000; ++i) points.push_back({static_cast<double>(i), static_cast<double>(3 * i)});
  EXPECT_FALSE(triangulatePoints(points).hasTriangles());
}

// The same two vertices are reported whichever part is triangulated first.
TEST(TriangulatePoints, ThatCoincideInSeveralPartsAreReportedAlike) {
  std::vector<Point> points = randomPoints(70000);
  for (std::size_t i = 0; i < points.size(); i += 5000) points.push_back(points[i]);
  const auto reported = [&](const ItemLoop& loop) {
    try {
      triangulatePoints(points, {}, loop);
    } catch (const Clash& clash) {
      EXPECT_EQ(clash.kind, Clash::Kind::PointsCoincide);
      return clash.at;
    }
    return kNone;
  };
  EXPECT_NE(reported(inOrder), kNone);
  EXPECT_EQ(reported(inOrder), reported(testing::backwards));
}

}  // namespace
}  // namespace coastmesh
