#include <gtest/gtest.h>

#include <cmath>

#include "parallel/mesh_regions.hpp"
#include "parallel/workers.hpp"
#include "tests/support/excused_twin.hpp"
#include "tests/support/mesh_checks.hpp"
#include "tests/support/pslgs.hpp"
#include "tests/support/size_figures.hpp"

namespace coastmesh {
namespace {

MeshedRegion meshed(const Pslg& pslg, const MeshOptions& options, int threads) {
  MeshedRegion region;
  withThreads({.threads = threads}, [&] { region = meshRegion(pslg, options); });
  return region;
}

class SizedRegion : public ::testing::TestWithParam<bool> {
 protected:
  const SizeOf size_{0.002, 0.05, [](const Point& p) { return 0.0025 + 0.02 * p.x * p.y; }};
  const Pslg pslg_ = squarePslg();
  MeshOptions options() const {
    MeshOptions options;
    options.refine.size = &size_;
    options.smooth = GetParam();
    return options;
  }
};

TEST_P(SizedRegion, InPiecesAsInOne) {
  MeshOptions one = options();
  one.one_piece = true;
  const MeshedRegion pieces = meshed(pslg_, options(), 2), whole = meshed(pslg_, one, 2);
  EXPECT_GT(pieces.pieces, 1u) << "nothing was cut";
  EXPECT_EQ(whole.pieces, 1u);
  for (const MeshedRegion* region : {&pieces, &whole}) {
    expectValidMesh(region->mesh, pslg_, {.min_angle_deg = 33.0});
    EXPECT_TRUE(region->stats.unresolved.empty());
    EXPECT_EQ(wrongBoundViolations(region->mesh, pslg_, options().refine, {}), "");
    const SizeFigures figures = sizeFigures(region->mesh, size_);
    EXPECT_GE(figures.share_within, 0.97);
    EXPECT_NEAR(figures.median, 1.0, 0.05);
    EXPECT_LE(figures.vertices_share, 1.15);
  }
}

TEST_P(SizedRegion, ThreadsChangeNoBit) {
  const std::uint64_t digest = digestOf(meshed(pslg_, options(), 1).mesh);
  for (const int threads : {2, 3}) EXPECT_EQ(digestOf(meshed(pslg_, options(), threads).mesh), digest) << threads;
}

INSTANTIATE_TEST_SUITE_P(Smooth, SizedRegion, ::testing::Bool(),
                         [](const auto& named) { return named.param ? "smooth" : "usual"; });

}  // namespace
}  // namespace coastmesh
