#include <gtest/gtest.h>

#include <memory>

#include "apps/job/mesh_job.hpp"
#include "tests/support/gis_shapes.hpp"

namespace coastmesh {
namespace {

// On a transverse Mercator plane the scale is least in the middle, where this square has no vertex.
TEST(ScaleRange, IsThatOfTheMesh) {
  MeshJob job;
  job.input.ready = std::make_shared<Coastline>(coastlineOf({polygonFeature(1, square(0, 40, 20))}, wgs84()));
  job.sizes.most_m = 1e5;
  const MeshJobResult result = runMeshJob(job);
  EXPECT_EQ(result.first_projection, "transverse Mercator, central meridian 10°");
  EXPECT_NEAR(result.least_scale, 1.0, 1e-4);
  EXPECT_NEAR(result.greatest_scale, 1.009, 1e-3);
}

}  // namespace
}  // namespace coastmesh
