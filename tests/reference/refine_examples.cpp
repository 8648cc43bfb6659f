// Examples of the headers in core/refine, core/size, core/sphere and parallel: each is run as a test and shown in the
// API reference.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "core/quality.hpp"
#include "core/refine/check.hpp"
#include "core/refine/mesh_defect.hpp"
#include "core/refine/refine.hpp"
#include "core/refine/refine_options.hpp"
#include "core/refine/vertex_notes.hpp"
#include "core/size/size_box.hpp"
#include "core/size/size_tree.hpp"
#include "core/sphere/close_sphere.hpp"
#include "core/triangulate/delaunay.hpp"
#include "parallel/mesh_regions.hpp"
#include "parallel/work_log.hpp"
#include "parallel/workers.hpp"

namespace coastmesh {
namespace {

Pslg bay() {
  Pslg bay;
  bay.points = {{0, 0}, {8, 0}, {8, 5}, {5, 5}, {4, 1}, {3, 5}, {0, 5}};
  bay.segments = {{0, 1}, {1, 2}, {2, 3}, {3, 4}, {4, 5}, {5, 6}, {6, 0}};
  return bay;
}

// core/refine/refine.hpp: From a triangulation to a mesh whose angles meet the bounds.
TEST(RefineExamples, Refine) {
  const Pslg pslg = bay();
  //! [core/refine/refine.hpp]
  RefineOptions options;
  options.min_angle_deg = 35.0;
  TriMesh mesh = constrainedDelaunay(pslg);
  RefineStats stats = refine(mesh, pslg, options);
  const std::size_t refined = mesh.points.size();
  stats.unresolved = coarsen(mesh, pslg, options).unresolved;  // removes vertices that the bounds do not need
  //! [core/refine/refine.hpp]
  EXPECT_LE(mesh.points.size(), refined);
  EXPECT_GT(mesh.points.size(), pslg.points.size());
  EXPECT_EQ(measureQuality(mesh, 35.0).bounds.unresolved(), 0u);
  EXPECT_TRUE(stats.unresolved.empty());
}

// core/refine/refine_options.hpp: Requirements on a refined mesh, and statistics of a run.
TEST(RefineExamples, RefineOptions) {
  //! [core/refine/refine_options.hpp]
  const ConstantSize size(0.5);
  RefineOptions options;
  options.min_angle_deg = 30.0;
  options.max_angle_deg = 110.0;
  options.size = &size;  // outlives the run
  options.max_vertices = 10'000;
  requireInRange(options);

  options.min_angle_deg = 60.0;
  std::string wrong;
  try {
    requireInRange(options);
  } catch (const std::invalid_argument& error) {
    wrong = error.what();
  }
  //! [core/refine/refine_options.hpp]
  EXPECT_NE(wrong, "");
  EXPECT_EQ(boundOf(options).size, &size);
}

// core/refine/check.hpp: All defects of a mesh, found independently of the code that made it.
TEST(RefineExamples, Check) {
  const Pslg pslg = bay();
  TriMesh mesh = constrainedDelaunay(pslg);
  refine(mesh, pslg, {});
  //! [core/refine/check.hpp]
  CheckOptions options;
  options.min_angle_deg = 33.0;
  const std::vector<MeshDefect> defects = checkMesh(mesh, &pslg, options);
  //! [core/refine/check.hpp]
  EXPECT_TRUE(defects.empty());
}

// core/refine/mesh_defect.hpp: Possible defects of a mesh.
TEST(RefineExamples, MeshDefect) {
  const Pslg pslg = bay();
  //! [core/refine/mesh_defect.hpp]
  TriMesh mesh = constrainedDelaunay(pslg);
  mesh.points[4] = {4, 6};  // across the shore
  std::vector<std::string_view> found;
  for (const MeshDefect& defect : checkMesh(mesh, &pslg, {})) found.push_back(toString(defect.kind));
  //! [core/refine/mesh_defect.hpp]
  EXPECT_NE(std::ranges::find(found, "input vertex missing"), found.end());
  EXPECT_NE(std::ranges::find(found, "triangle not counter-clockwise"), found.end());
}

// core/refine/vertex_notes.hpp: Data of refinement on vertices besides their positions.
TEST(RefineExamples, VertexNotes) {
  const Pslg pslg = bay();
  //! [core/refine/vertex_notes.hpp]
  RefineOptions options;
  TriMesh mesh = constrainedDelaunay(pslg);
  VertexNotes notes = noteInput(mesh, boundOf(options));
  const double room = notes.spacing[4];  // at most the distance to the nearest edge that does not end there
  refine(mesh, pslg, options, std::move(notes));
  //! [core/refine/vertex_notes.hpp]
  EXPECT_GT(room, 0.0);
  EXPECT_LE(room, 1.0 + 1e-12);
}

// core/size/size_box.hpp: A square in the plane, for queries of sizes.
TEST(RefineExamples, SizeBox) {
  //! [core/size/size_box.hpp]
  const SizeBox box{{10.0, 20.0}, 0.5};  // from 9.5 to 10.5, and from 19.5 to 20.5
  //! [core/size/size_box.hpp]
  EXPECT_EQ(box.centre.x - box.half, 9.5);
}

// core/size/size_tree.hpp: Makes a size function with bounded gradation from any source of sizes.
TEST(RefineExamples, SizeTree) {
  //! [core/size/size_tree.hpp]
  class FineInTheMiddle final : public SizeSource {  // 0.1 within a distance of 1, 2 elsewhere
   public:
    void sample(std::span<const Point> places, std::span<double> sizes) const override {
      for (std::size_t i = 0; i < places.size(); ++i) sizes[i] = sizeAt(std::hypot(places[i].x, places[i].y));
    }
    void bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const override {
      for (std::size_t i = 0; i < boxes.size(); ++i) {
        const double away = std::hypot(boxes[i].centre.x, boxes[i].centre.y);
        const double reach = boxes[i].half * std::numbers::sqrt2;
        ranges[i] = {sizeAt(std::max(0.0, away - reach)), sizeAt(away + reach)};
      }
    }

   private:
    static double sizeAt(double away) { return away < 1.0 ? 0.1 : 2.0; }
  };
  SizeTreeOptions options;
  options.gradation = 0.2;
  const SizeTree sizes({-10, -10}, {10, 10}, FineInTheMiddle(), options);
  //! [core/size/size_tree.hpp]
  ASSERT_TRUE(sizes.isComplete());
  EXPECT_NEAR(sizes.at({0, 0}), 0.1, 1e-6);
  EXPECT_LE(sizes.at({3, 0}), 0.1 + 0.2 * 3.0);  // grows with the distance
  EXPECT_GT(sizes.at({9, 9}), 1.0);
}

// core/sphere/close_sphere.hpp: The ring that a mesh of a whole sphere leaves open, and the cap that closes it.
TEST(RefineExamples, CloseSphere) {
  //! [core/sphere/close_sphere.hpp]
  const Surface globe = Surface::sphere(1.0);
  const SphereCap cap = sphereCap(globe, 0.5, 6);
  Pslg pslg;
  pslg.points = cap.ring;
  for (VertexId v = 0; v < 6; ++v) pslg.segments.push_back({v, (v + 1) % 6});
  TriMesh mesh = constrainedDelaunay(pslg, globe);
  freezeRing(mesh, 0, cap);  // the ring's corners are the first vertices
  closeSphere(mesh, 0, cap);
  //! [core/sphere/close_sphere.hpp]
  EXPECT_TRUE(isClosed(mesh));
  EXPECT_EQ(eulerNumber(mesh), 2);
}

// parallel/mesh_regions.hpp: A region triangulated, refined and coarsened on all available threads.
TEST(RefineExamples, MeshRegions) {
  const Pslg pslg = bay();
  //! [parallel/mesh_regions.hpp]
  MeshOptions options;
  options.refine.min_angle_deg = 33.0;
  MeshedRegion region;
  withThreads({}, [&] { region = meshRegion(pslg, options); });
  //! [parallel/mesh_regions.hpp]
  EXPECT_EQ(measureQuality(region.mesh, 33.0).bounds.unresolved(), 0u);
  EXPECT_EQ(region.pieces, 1u);
}

// parallel/work_log.hpp: The work of a run, and how long it would take with other numbers of threads.
TEST(RefineExamples, WorkLog) {
  //! [parallel/work_log.hpp]
  WorkLog log;
  log.addAlone("read", 2.0);
  log.stages.push_back({"refine", 0.0, {3.0, 3.0, 3.0, 3.0}});
  const double one = log.timeOn(1), two = log.timeOn(2);
  //! [parallel/work_log.hpp]
  EXPECT_EQ(one, 14.0);
  EXPECT_EQ(two, 8.0);
  EXPECT_EQ(log.work(), 14.0);
}

// parallel/workers.hpp: Threads, and loops shared among them.
TEST(RefineExamples, Workers) {
  //! [parallel/workers.hpp]
  ParallelOptions options;
  options.threads = 2;
  std::vector<int> squares(100);
  withThreads(options,
              [&] { forEachItem(squares.size(), {}, [&](std::size_t i) { squares[i] = static_cast<int>(i * i); }); });
  //! [parallel/workers.hpp]
  EXPECT_EQ(squares[99], 9801);
}

}  // namespace
}  // namespace coastmesh
