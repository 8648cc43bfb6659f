#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <vector>

#include "gis/check/check_target.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/boundary_kinds.hpp"
#include "gis/repair/repair_target.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh::testing {

// All but FESOM2, which refuses two corners of the grid below.
inline constexpr Target kAll[] = {Target::Adcirc,  Target::Schism, Target::Fvcom, Target::Telemac,
                                  Target::Dflowfm, Target::Swan,   Target::Mpas};

// The mesh's nodes and triangles, without depths and boundaries.
inline Grid gridOf(const TriMesh& mesh) {
  Grid grid;
  grid.nodes = mesh.points;
  for (const Triangle& t : mesh.triangles) grid.triangles.push_back(t.v);
  return grid;
}

// A sea of nearly equilateral triangles of a kilometre, with an island or not; no corner has both its edges in one
// triangle.
inline Grid soundGrid(bool island = true) {
  const TriMesh mesh = lattice(
      8, 8, [island](int i, int j) { return !island || i != 4 || j != 4; },
      [](int i, int j) {
        return Point{1000.0 * i - 500.0 * j, 866.0 * j};
      });
  Grid grid = gridOf(mesh);
  for (std::size_t i = 0; i < grid.nodes.size(); ++i) grid.z.push_back(-20.0 - 0.5 * static_cast<double>(i % 7));
  grid.boundaries = findBoundaries(mesh);
  return grid;
}

// The sound grid with an open southern side.
inline Grid openGrid() {
  Grid grid = soundGrid();
  const auto loops = boundaryLoops(grid);
  grid.boundaries = cutLoops(grid, loops, [&](std::uint32_t a, std::uint32_t b) {
    return BoundaryKind{grid.nodes[a].y == 0.0 && grid.nodes[b].y == 0.0 ? BoundaryRole::Open : BoundaryRole::Land};
  });
  return grid;
}

// Without advice for FVCOM: the corners of samples have one neighbour.
inline std::set<TargetDefectKind> kindsIn(const Grid& grid, Target target, const TargetCheckOptions& options = {}) {
  std::set<TargetDefectKind> kinds;
  for (const TargetDefect& defect : checkTarget(grid, target, options))
    if (target != Target::Fvcom || !defect.advice) kinds.insert(defect.kind);
  return kinds;
}

using Kinds = std::set<TargetDefectKind>;

// After repair, the grid has no defect for any of the targets and covers the same area except `lost`; repairs are
// reported.
inline void expectMended(Grid grid, std::vector<Target> targets, double lost = 0.0) {
  const auto area = [](const Grid& of) {
    double sum = 0.0;
    for (const auto& [a, b, c] : of.triangles) {
      const Point &p = of.nodes[a], &q = of.nodes[b], &r = of.nodes[c];
      sum += std::abs((q.x - p.x) * (r.y - p.y) - (r.x - p.x) * (q.y - p.y)) / 2.0;
    }
    return sum;
  };
  const double before = area(grid);
  const RepairReport report = repairForTargets(grid, targets);
  EXPECT_TRUE(report.left.empty()) << toString(report.left.front().second.kind);
  EXPECT_FALSE(report.repairs.empty());
  for (const Target target : targets) EXPECT_EQ(kindsIn(grid, target), Kinds{});
  EXPECT_NEAR(area(grid), before, lost + 1e-6 * before);
  EXPECT_EQ(grid.z.size(), grid.nodes.size());
  for (const double z : grid.z) EXPECT_TRUE(z <= -20.0 && z >= -23.0);
}

}  // namespace coastmesh::testing
