// What an edit is said to change, against defects counted in the whole mesh before and after it.
#include "gis/repair/repair_score.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/quality.hpp"
#include "gis/model/check_target.hpp"
#include "gis/repair/repair_shore.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using testing::lattice;

// A lattice whose nodes are moved so far that many triangles and edges are as models refuse them.
Grid shakenGrid(unsigned seed, const Crs& crs) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> shake(-0.38, 0.38);
  std::map<std::pair<int, int>, Point> moved;
  const TriMesh mesh = lattice(
      7, 7, [](int i, int j) { return i != 3 || j != 3; },
      [&](int i, int j) {
        const auto [at, fresh] = moved.try_emplace({i, j});
        if (fresh) at->second = {0.01 * (i - 0.5 * j + shake(random)), 0.01 * (0.866 * j + shake(random))};
        return at->second;
      });
  Grid grid;
  grid.crs = crs;
  grid.nodes = mesh.points;
  for (const Triangle& t : mesh.triangles) grid.triangles.push_back(t.v);
  grid.boundaries = cutLoops(grid, boundaryLoops(grid), [&](std::uint32_t a, std::uint32_t b) {
    return BoundaryKind{std::min(a, b) % 3 == 0 ? BoundaryRole::Open : BoundaryRole::Land};
  });
  return grid;
}

GridLinks linksOf(const Grid& grid) {
  GridLinks links;
  std::vector<EdgeConflict> conflicts;
  links.mesh = linkTriangles(grid.nodes, grid.triangles, conflicts);
  links.triangles_at.resize(grid.nodes.size());
  for (std::uint32_t t = 0; t < grid.triangles.size(); ++t)
    for (const std::uint32_t node : grid.triangles[t]) links.triangles_at[node].push_back(t);
  links.on_boundary.assign(grid.nodes.size(), false);
  const EdgeKinds kinds(grid);
  for (const auto& loop : boundaryLoops(grid)) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t a = loop[i], b = loop[(i + 1) % loop.size()];
      links.kinds[edgeKey(a, b)] = *kinds.find(a, b);
      links.on_boundary[a] = true;
    }
  }
  return links;
}

Grid edited(Grid grid, const GridLinks& links, const PatchEdit& edit) {
  if (edit.placed == grid.nodes.size()) grid.nodes.emplace_back();
  if (edit.placed != kNone) grid.nodes[edit.placed] = edit.place;
  for (const EditedTriangle& triangle : edit.triangles) {
    if (triangle.slot == kNone) {
      grid.triangles.push_back(triangle.v);
    } else {
      grid.triangles[triangle.slot] = triangle.v;
    }
  }
  if (!edit.removed.empty()) {
    std::vector<bool> gone(grid.triangles.size(), false);
    for (const std::uint32_t t : edit.removed) gone[t] = true;
    removeTriangles(grid, gone);
  }
  grid.boundaries = cutLoops(grid, boundaryLoops(grid), [&](std::uint32_t a, std::uint32_t b) {
    const NodePair key = edgeKey(a, b);
    return edit.made.contains(key) ? edit.made.at(key) : links.kinds.at(key);
  });
  removeUnusedNodes(grid);
  return grid;
}

// Kinds that flips and splits are to mend; triangles too few or too many round a node count one by one.
int defectsOf(const Grid& grid, Target target) {
  int count = 0;
  for (const TargetDefect& defect : checkTarget(grid, target)) {
    if (defect.kind == TargetDefectKind::Valence) {
      const int cells = static_cast<int>(defect.value);
      count += target == Target::Fesom ? cells - 32 : std::max(4 - cells, cells - 10);
    } else {
      count += defect.kind != TargetDefectKind::LoneWall;
    }
  }
  return count;
}

bool hasTurned(const Grid& grid) {
  for (const TargetDefect& defect : checkTarget(grid, Target::Telemac))
    if (defect.kind == TargetDefectKind::Clockwise) return true;
  return false;
}

void expectTrueScores(Target target, const Crs& crs) {
  int judged = 0, changed = 0, collapsed = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    const Grid grid = shakenGrid(seed, crs);
    if (hasTurned(grid)) continue;
    const GridLinks links = linksOf(grid);
    const std::array targets{target};
    std::vector<double> smallest_angle(grid.triangles.size(), std::numeric_limits<double>::quiet_NaN());
    const std::vector<double> metres(grid.triangles.size(), 1.0);
    RepairView view{grid, links, targets, smallest_angle, {0.0, 0.0, metres}};
    const ShoreIndex shores(view);
    view.shores = &shores;
    const int before = defectsOf(grid, target);
    for (std::uint32_t t = 0; t < grid.triangles.size(); t += 5) {
      std::vector<std::uint32_t> near;
      for (const std::uint32_t node : grid.triangles[t])
        near.insert(near.end(), links.triangles_at[node].begin(), links.triangles_at[node].end());
      const Patch patch = patchRound(view, near);
      const PatchScale scale = scaleOf(view, patch);
      for (unsigned i = 0; i < 3; ++i) {
        const std::uint32_t a = grid.triangles[t][i], b = grid.triangles[t][next3(i)];
        const std::uint32_t c = grid.triangles[t][prev3(i)];
        std::vector<std::optional<PatchEdit>> edits{flipOf(view, patch, a, b), splitOf(view, patch, a, b, 0.4)};
        if (isMovable(view, a)) edits.push_back(moveOf(view, a, b, c, 0.3));
        for (const double share : {0.0, 0.4}) edits.push_back(collapseOf(view, a, b, share));
        for (const auto& edit : edits) {
          if (!edit) continue;
          collapsed += edit->kind == PatchEditKind::EdgeCollapse;
          const Grid after = edited(grid, links, *edit);
          const int said = scoreOf(view, patch, scale, *edit).defects;
          EXPECT_EQ(said == kTurnedOver, hasTurned(after));
          if (said == kTurnedOver) continue;
          EXPECT_EQ(said, defectsOf(after, target) - before) << "seed " << seed << ", edge " << a << " " << b;
          ++judged;
          changed += said != 0;
        }
      }
    }
  }
  EXPECT_GT(judged, 200);
  EXPECT_GT(changed, 8);
  EXPECT_GT(collapsed, 100);
}

TEST(RepairScore, IsWhatTheWholeMeshGains) {
  for (const Target target : {Target::Swan, Target::Dflowfm, Target::Fvcom, Target::Fesom, Target::Mpas}) {
    SCOPED_TRACE(kTargetNames[static_cast<std::size_t>(target)]);
    expectTrueScores(target, {});
    expectTrueScores(target, wgs84());
  }
}

}  // namespace
}  // namespace coastmesh
