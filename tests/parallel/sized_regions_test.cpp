#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

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

TEST_P(SizedRegion, ProgressRises) {
  for (const bool one_piece : {false, true}) {
    MeshOptions options = this->options();
    options.one_piece = one_piece;
    std::vector<double> shares;
    const RunControl control{{}, [&](double share) { shares.push_back(share); }};
    withThreads({.threads = 2}, [&] { meshRegion(pslg_, options, control); });
    // Stages that need a share again report it again.
    EXPECT_TRUE(one_piece || std::ranges::is_sorted(shares));
    EXPECT_LT(shares.front(), 0.1);
    EXPECT_GT(shares.back(), 0.8);
    EXPECT_LE(std::ranges::max(shares), 1.0);
    for (const double third : {0.0, 1.0 / 3.0, 2.0 / 3.0})
      EXPECT_TRUE(std::ranges::any_of(shares, [&](double s) { return s > third && s < third + 1.0 / 3.0; })) << third;
  }
}

TEST_P(SizedRegion, SplitsOfSegmentsCount) {
  const Pslg square = squarePslg();
  for (const bool one_piece : {false, true}) {
    MeshOptions options = this->options();
    options.one_piece = one_piece;
    options.coarsen = false;
    const MeshedRegion region = meshed(square, options, 2);
    std::size_t on_segments = 0;
    const auto isOnSide = [](double x) { return x == 0.0 || x == 1.0; };
    for (const Point& p : region.mesh.points) on_segments += isOnSide(p.x) || isOnSide(p.y);
    EXPECT_GE(region.stats.segment_splits, on_segments - square.points.size());
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
