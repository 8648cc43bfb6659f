#include "core/refine/submesh_runs.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "core/refine/bound_violations.hpp"
#include "core/triangulate/delaunay.hpp"
#include "tests/support/pslgs.hpp"

namespace coastmesh {
namespace {

// The parameter: whether the run also repairs.
class RefineSubmesh : public ::testing::TestWithParam<bool> {
 protected:
  MeshState unrefined() const {
    MeshState state;
    state.mesh = constrainedDelaunay(pslg_);
    state.notes = noteInput(state.mesh, boundOf(options_));
    state.due_triangles.assign(state.mesh.triangles.size(), 1);
    return state;
  }
  std::vector<TriId> violations(const MeshState& state) const {
    return trianglesInViolation(state.mesh, options_, state.notes.corners.get());
  }

  const Pslg pslg_ = fractalCoast(3, 2, 3);
  const RefineOptions options_{.min_angle_deg = 30.0};
};

TEST_P(RefineSubmesh, WhatMaxVerticesLeavesIsDue) {
  MeshState whole = unrefined();
  refineSubmesh(whole, pslg_, options_, true);
  ASSERT_TRUE(violations(whole).empty());
  const std::size_t inserted = whole.mesh.points.size() - pslg_.points.size();
  for (const double share : {0.0, 0.3, 0.9, 0.99}) {
    MeshState state = unrefined();
    RefineOptions limited = options_;
    limited.max_vertices = pslg_.points.size() + static_cast<std::uint64_t>(share * static_cast<double>(inserted));
    EXPECT_TRUE(refineSubmesh(state, pslg_, limited, GetParam()).budget_reached);
    EXPECT_LE(state.mesh.points.size(), limited.max_vertices);
    const std::vector<TriId> left = violations(state);
    EXPECT_FALSE(left.empty());
    for (const TriId t : left) EXPECT_TRUE(state.due_triangles[t]) << share;
    EXPECT_FALSE(refineSubmesh(state, pslg_, options_, true).budget_reached);
    EXPECT_TRUE(violations(state).empty()) << share;
  }
}

INSTANTIATE_TEST_SUITE_P(Mends, RefineSubmesh, ::testing::Bool(),
                         [](const auto& named) { return named.param ? "yes" : "no"; });

}  // namespace
}  // namespace coastmesh
