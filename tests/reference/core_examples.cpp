// Examples of the headers in core/: each is run as a test and shown in the API reference.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "core/box_halves.hpp"
#include "core/bulk_list.hpp"
#include "core/ids.hpp"
#include "core/input_corners.hpp"
#include "core/item_loop.hpp"
#include "core/linked_triangles.hpp"
#include "core/metric.hpp"
#include "core/point.hpp"
#include "core/pslg.hpp"
#include "core/quality.hpp"
#include "core/run_control.hpp"
#include "core/size_function.hpp"
#include "core/space_point.hpp"
#include "core/surface.hpp"
#include "core/tri_mesh.hpp"
#include "core/triangulate/delaunay.hpp"
#include "core/triangulate/label_regions.hpp"

namespace coastmesh {
namespace {

Pslg unitSquare() {
  Pslg square;
  square.points = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  square.segments = {{0, 1}, {1, 2}, {2, 3}, {3, 0}};
  return square;
}

// core/box_halves.hpp: Boxes in the plane, and a search among many of them.
TEST(CoreExamples, BoxHalves) {
  //! [core/box_halves.hpp]
  std::vector<Bounds> boxes(3);
  boxes[0].add(Point{0, 0});
  boxes[0].add(Point{1, 1});
  boxes[1].add(Point{0.5, 0.5});
  boxes[1].add(Point{2, 2});
  boxes[2].add(Point{5, 5});
  const BoxHalves halves(boxes);
  std::vector<std::uint32_t> near;  // a leaf has several boxes, so the search visits more than needed
  const Point place{0.7, 0.7};
  halves.visit([&](const Bounds& bounds) { return bounds.holds(place); },
               [&](std::uint32_t item) {
                 if (boxes[item].holds(place)) near.push_back(item);
               });
  //! [core/box_halves.hpp]
  std::ranges::sort(near);
  EXPECT_EQ(near, (std::vector<std::uint32_t>{0, 1}));
}

// core/bulk_list.hpp: Long arrays that are not set before they are written.
TEST(CoreExamples, BulkList) {
  //! [core/bulk_list.hpp]
  const ItemLoop loop = inOrder;  // or one that uses several threads
  BulkList<double> squares;
  resizeUnset(squares, 1000);  // no value yet
  forEachByStretches(loop, squares.size(), [&](std::size_t i) { squares[i] = static_cast<double>(i * i); });
  const BulkList<double> copy = copyOn(loop, squares);
  //! [core/bulk_list.hpp]
  EXPECT_EQ(copy[30], 900.0);
}

// core/triangulate/delaunay.hpp: The constrained Delaunay triangulation of a plane graph, and errors for an invalid
// graph.
TEST(CoreExamples, Delaunay) {
  const Pslg square = unitSquare();
  //! [core/triangulate/delaunay.hpp]
  const TriMesh mesh = constrainedDelaunay(square);

  Pslg crossed = square;
  crossed.segments = {{0, 2}, {1, 3}};
  std::string wrong;
  try {
    constrainedDelaunay(crossed);
  } catch (const BadPslg& error) {
    wrong = error.defect.message;  // error.defect.place and .segment locate it
  }
  //! [core/triangulate/delaunay.hpp]
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_FALSE(wrong.empty());
}

// core/ids.hpp: Numbers of vertices, triangles, segments and regions.
TEST(CoreExamples, Ids) {
  //! [core/ids.hpp]
  const VertexId first = 0;
  const TriId across = kNone;  // no neighbour: the edge lies on the boundary
  const RegionId land = kOutside;
  //! [core/ids.hpp]
  EXPECT_NE(first, across);
  EXPECT_LT(land, 0);
}

// core/input_corners.hpp: Corners of the input that are too small for the bounds, and the triangles that they excuse.
TEST(CoreExamples, InputCorners) {
  //! [core/input_corners.hpp]
  Pslg wedge;  // an angle of 5.7 degrees at its first point
  wedge.points = {{0, 0}, {10, 0}, {10, 1}};
  wedge.segments = {{0, 1}, {1, 2}, {2, 0}};
  const TriMesh mesh = constrainedDelaunay(wedge);
  const TriangleBound bound(30.0, 180.0, std::numeric_limits<double>::infinity());
  const InputCorners corners(mesh, bound);
  const Excuse excuse = corners.excuseOf(mesh.points[0], mesh.points[1], mesh.points[2]);
  //! [core/input_corners.hpp]
  ASSERT_EQ(corners.all().size(), 1u);
  EXPECT_EQ(corners.all()[0].apex, (Point{0, 0}));
  EXPECT_EQ(excuse, Excuse::Corner);
}

// core/item_loop.hpp: Loops that can run on the caller's threads.
TEST(CoreExamples, ItemLoop) {
  //! [core/item_loop.hpp]
  const ItemLoop loop = inOrder;  // one thread; `forEachItem` of parallel/workers.hpp uses several
  std::vector<double> roots(20000);
  forEachByStretches(loop, roots.size(), [&](std::size_t i) { roots[i] = std::sqrt(static_cast<double>(i)); });
  const std::vector<double> sums = overStretches(loop, roots.size(), [&](std::size_t first, std::size_t last) {
    double sum = 0.0;
    for (std::size_t i = first; i < last; ++i) sum += roots[i];
    return sum;
  });
  //! [core/item_loop.hpp]
  EXPECT_EQ(sums.size(), 2u);
  EXPECT_EQ(roots[10000], 100.0);
}

// core/linked_triangles.hpp: Triangles linked to their neighbours, and references to their edges.
TEST(CoreExamples, LinkedTriangles) {
  const TriMesh mesh = constrainedDelaunay(unitSquare());
  //! [core/linked_triangles.hpp]
  std::size_t boundary = 0;
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef edge = edgeRef(t, i);  // from mesh.origin(edge) to mesh.target(edge)
      if (mesh.twin(edge) == kNone) ++boundary;
    }
  }
  //! [core/linked_triangles.hpp]
  EXPECT_EQ(boundary, 4u);
}

// core/metric.hpp: Lengths, angles, and bounds on triangles.
TEST(CoreExamples, Metric) {
  //! [core/metric.hpp]
  const Point a{0, 0}, b{4, 0}, c{0, 3};
  const double hypotenuse = distance(b, c);
  const double at_b = toDegrees(angleAt(b, a, c));
  const TriangleBound bound(33.0, 180.0, std::numeric_limits<double>::infinity());
  const bool good = !isBad(a, b, c, bound);
  //! [core/metric.hpp]
  EXPECT_EQ(hypotenuse, 5.0);
  EXPECT_NEAR(at_b, 36.87, 0.01);
  EXPECT_TRUE(good);
}

// core/point.hpp: A point in a plane.
TEST(CoreExamples, Point) {
  //! [core/point.hpp]
  std::vector<Point> points = {{1, 0}, {0, 2}, {0, 1}};
  std::ranges::sort(points, lexLess);
  //! [core/point.hpp]
  EXPECT_EQ(points, (std::vector<Point>{{0, 1}, {0, 2}, {1, 0}}));
}

// core/triangulate/label_regions.hpp: The regions beside segments, and those of triangles.
TEST(CoreExamples, LabelRegions) {
  //! [core/triangulate/label_regions.hpp]
  Pslg square = unitSquare();
  labelSegments(square);  // region 0 inside, kOutside beyond
  const auto sides = std::ranges::count_if(square.segments, isBoundary);
  //! [core/triangulate/label_regions.hpp]
  EXPECT_TRUE(hasRegions(square));
  EXPECT_EQ(sides, 4);
}

// core/pslg.hpp: A planar straight-line graph, the input of the core.
TEST(CoreExamples, Pslg) {
  //! [core/pslg.hpp]
  Pslg ring;  // a square with a square hole
  ring.points = {{0, 0}, {3, 0}, {3, 3}, {0, 3}, {1, 1}, {2, 1}, {2, 2}, {1, 2}};
  ring.segments = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6}, {6, 7}, {7, 4}};
  ring.holes = {{1.5, 1.5}};
  //! [core/pslg.hpp]
  EXPECT_EQ(measureQuality(constrainedDelaunay(ring), 0.0).area, 8.0);
}

// core/quality.hpp: Angles, areas and lengths of a mesh.
TEST(CoreExamples, Quality) {
  const TriMesh mesh = constrainedDelaunay(unitSquare());
  //! [core/quality.hpp]
  const MeshQuality quality = measureQuality(mesh, 33.0);
  const std::array<double, 3> angles = anglesDeg({0, 0}, {1, 0}, {0, 1});
  //! [core/quality.hpp]
  EXPECT_NEAR(quality.min_angle_deg, 45.0, 1e-12);
  EXPECT_EQ(quality.bounds.below, 0u);
  EXPECT_NEAR(angles[0], 90.0, 1e-12);
}

// core/run_control.hpp: Progress and cancellation of a long run.
TEST(CoreExamples, RunControl) {
  //! [core/run_control.hpp]
  double done = 0.0;
  RunControl control;
  control.progress = [&](double share) { done = share; };
  control.cancelled = [&] { return done > 0.5; };
  bool stopped = false;
  try {
    for (int step = 0; step <= 10; ++step) control.checkpoint(0.1 * step);
  } catch (const Cancelled&) {
    stopped = true;
  }
  //! [core/run_control.hpp]
  EXPECT_TRUE(stopped);
  EXPECT_LT(done, 0.7);
}

// core/size_function.hpp: The requested edge length at each place.
TEST(CoreExamples, SizeFunction) {
  //! [core/size_function.hpp]
  class Growing final : public SizeFunction {  // 0.1 at the origin, growing by a fifth of the distance, up to 1
   public:
    double at(const Point& x) const override { return std::min(1.0, 0.1 + 0.2 * std::hypot(x.x, x.y)); }
    double least() const override { return 0.1; }
    double most() const override { return 1.0; }
  };
  const Growing size;
  //! [core/size_function.hpp]
  EXPECT_NEAR(size.at({1, 0}), 0.3, 1e-12);
  EXPECT_EQ(ConstantSize(2.0).at({1, 0}), 2.0);
}

// core/space_point.hpp: A point or a vector in space.
TEST(CoreExamples, SpacePoint) {
  //! [core/space_point.hpp]
  const SpacePoint east{1, 0, 0}, north{0, 1, 0};
  const SpacePoint up = cross(east, north);
  const double apart = distance(east, north);
  //! [core/space_point.hpp]
  EXPECT_EQ(up.z, 1.0);
  EXPECT_NEAR(apart * apart, 2.0, 1e-12);
}

// core/surface.hpp: The surface that the plane represents: the plane itself, or a sphere mapped to it.
TEST(CoreExamples, Surface) {
  //! [core/surface.hpp]
  const Surface earth = Surface::sphere(6371.0);  // kilometres
  // In a stereographic projection a chord from its origin is shorter than the distance in the plane.
  const Point pole{0, 0}, far{2 * 6371.0, 0};  // `far` is on the equator, 90 degrees from the pole
  const double chord = earth.chord(pole, far);
  //! [core/surface.hpp]
  EXPECT_NEAR(chord, std::sqrt(2.0) * 6371.0, 1e-6);
  EXPECT_NEAR(earth.radius(), 6371.0, 1e-9);
  EXPECT_FALSE(Surface{}.isCurved());
}

// core/tri_mesh.hpp: The triangle mesh that all stages work on.
TEST(CoreExamples, TriMesh) {
  //! [core/tri_mesh.hpp]
  const std::vector<std::array<VertexId, 3>> corners = {{0, 1, 2}, {0, 2, 3}};
  std::vector<EdgeConflict> conflicts;
  const TriMesh mesh = linkTriangles({{0, 0}, {1, 0}, {1, 1}, {0, 1}}, corners, conflicts);
  const std::vector<std::vector<VertexId>> loops = boundaryLoops(mesh);
  const std::uint64_t digest = digestOf(mesh);  // the same on every machine
  //! [core/tri_mesh.hpp]
  EXPECT_TRUE(conflicts.empty());
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_EQ(loops[0], (std::vector<VertexId>{0, 1, 2, 3}));
  TriMesh moved = mesh;
  moved.points[2].x += 1e-15;
  EXPECT_NE(digest, digestOf(moved));
}

}  // namespace
}  // namespace coastmesh
