// The number of vertices that sizes need is said before a long run, so that it can be stopped.
#include <gtest/gtest.h>

#include <atomic>
#include <memory>

#include "apps/job/mesh_job.hpp"
#include "core/run_control.hpp"
#include "tests/support/gis_shapes.hpp"

namespace coastmesh {
namespace {

// A square of 4 km, with edges of so many metres.
MeshJob jobOf(double size_m) {
  MeshJob job;
  job.input.ready = std::make_shared<Coastline>(coastlineOf({polygonFeature(1, square(0, 0, 4000))}, Crs{}));
  job.sizes.size_m = size_m;
  return job;
}

TEST(ExpectedVertices, AreSaidBeforeALongRun) {
  std::atomic<double> expected{0.0};
  JobControl control{[&] { return expected > 0.0; }, {}, [&](double vertices) { expected = vertices; }};
  EXPECT_THROW(runMeshJob(jobOf(2.0), control), Cancelled);
  const double of_equilateral = 4000.0 * 4000.0 / (2.0 * 2.0 * 0.866);
  EXPECT_GT(expected, 0.8 * of_equilateral);
  EXPECT_LT(expected, 2.0 * of_equilateral);
}

TEST(ExpectedVertices, OfAShortRunAreNot) {
  JobControl control{{}, {}, [](double) { FAIL(); }};
  EXPECT_GT(runMeshJob(jobOf(100.0), control).grid.triangles.size(), 2000u);
}

}  // namespace
}  // namespace coastmesh
