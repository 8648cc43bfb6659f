// The predicted effect of an edit, against the defects of the whole mesh before and after it.
#include "gis/repair/repair_score.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/quality.hpp"
#include "gis/check/check_target.hpp"
#include "gis/grid/local_plane.hpp"
#include "gis/repair/repair_shore.hpp"
#include "gis/repair/repair_target.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using testing::lattice;

// A lattice with nodes moved so far that models refuse many of its triangles and edges.
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
  const EdgeKinds kinds(grid);
  for (const auto& loop : boundaryLoops(grid)) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::uint32_t a = loop[i], b = loop[(i + 1) % loop.size()];
      links.kinds[edgeKey(a, b)] = *kinds.find(a, b);
    }
  }
  flagBoundaryNodes(links, grid.nodes.size());
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

// Weighted, of kinds that flips and splits repair; triangles too few or too many around a node count one by one.
int defectsOf(const Grid& grid, Target target) {
  int count = 0;
  for (const TargetDefect& defect : checkTarget(grid, target)) {
    if (defect.kind == TargetDefectKind::Valence) {
      const int cells = static_cast<int>(defect.value);
      count += kDefectWeight * (target == Target::Fesom ? cells - 32 : std::max(4 - cells, cells - 10));
    } else if (defect.kind != TargetDefectKind::LoneWall) {
      count += defect.advice ? 1 : kDefectWeight;
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
    RepairView view{grid, links, targets, smallest_angle, {}, {0.0, 0.0, metres}};
    const ShoreIndex shores(view);
    view.shores = &shores;
    const int before = defectsOf(grid, target);
    for (std::uint32_t t = 0; t < grid.triangles.size(); t += 5) {
      std::vector<std::uint32_t> near;
      for (const std::uint32_t node : grid.triangles[t])
        near.insert(near.end(), links.triangles_at[node].begin(), links.triangles_at[node].end());
      const GridPatch patch = patchRound(view, near);
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

// Depths of 10 to 90 m, so that some triangles miss a step of 35 s.
constexpr double kStep = 35.0;
Grid shakenSea(unsigned seed, const Crs& crs) {
  Grid grid = shakenGrid(seed, crs);
  if (!crs.geographic)
    for (Point& p : grid.nodes) p = {100'000.0 * p.x, 100'000.0 * p.y};
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> depth(10.0, 90.0);
  for (std::size_t i = 0; i < grid.nodes.size(); ++i) grid.z.push_back(i % 11 == 0 ? 2.0 : -depth(random));
  return grid;
}

// Calls `use(view, patch, node)` for inner nodes of shaken seas and the patches around their triangles.
void forEachInnerNode(std::span<const Target> targets, const Crs& crs, auto&& use) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    const Grid grid = shakenSea(seed, crs);
    if (hasTurned(grid)) continue;
    const GridLinks links = linksOf(grid);
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> smallest_angle(grid.triangles.size(), kUnknown);
    std::vector<SphereVector> in_space(crs.geographic ? grid.nodes.size() : 0, SphereVector{kUnknown, 0.0, 0.0});
    const std::vector<double> metres(grid.triangles.size(), 1.001);
    const RepairView view{grid, links, targets, smallest_angle, in_space, {kStep, 0.0, metres}};
    for (std::uint32_t node = 0; node < grid.nodes.size(); ++node)
      if (isMovable(view, node)) use(view, patchRound(view, links.triangles_at[node]), node);
  }
}

std::vector<PatchEdit> movesOf(const RepairView& view, std::uint32_t node) {
  std::vector<PatchEdit> moves;
  for (const std::uint32_t other : neighboursOf(view, node))
    for (const double share : {0.05, 0.3, 0.6}) moves.push_back(moveOf(view, node, other, other, share));
  return moves;
}

constexpr std::array<std::array<Target, 1>, 3> kTargetsOfScores{{{Target::Fvcom}, {Target::Swan}, {Target::Dflowfm}}};

TEST(RepairScore, AnglesAreThoseOnTheShapeOfTheEarth) {
  for (const EarthShape shape : {EarthShape::Ellipsoid, EarthShape::Sphere}) {
    int judged = 0;
    double apart = 0.0;  // the largest difference from angles on the other shape
    forEachInnerNode({}, wgs84(), [&](const RepairView& view, const GridPatch& patch, std::uint32_t node) {
      std::vector<double> unknown(view.grid.triangles.size(), std::numeric_limits<double>::quiet_NaN());
      RepairView shaped = view;
      shaped.shape = shape;
      shaped.in_space = {};
      shaped.smallest_angle = unknown;
      const PatchScale scale = scaleOf(shaped, patch);
      for (const PatchEdit& edit : movesOf(shaped, node)) {
        const EditScore score = scoreOf(shaped, patch, scale, edit);
        if (score.defects == kTurnedOver) continue;
        double least = 180.0, least_of_other = 180.0;
        for (const EditedTriangle& triangle : edit.triangles) {
          std::array<Point, 3> p;
          for (unsigned i = 0; i < 3; ++i)
            p[i] = triangle.v[i] == edit.placed ? edit.place : view.grid.nodes[triangle.v[i]];
          for (const EarthShape of : {EarthShape::Ellipsoid, EarthShape::Sphere}) {
            const std::vector<Point> plane = localPlane(view.grid.crs, p, of);
            double& angle = of == shape ? least : least_of_other;
            angle = std::min(angle, leastAngleDeg(plane[0], plane[1], plane[2]));
          }
        }
        EXPECT_NEAR(score.made_angle, least, 1e-9);
        apart = std::max(apart, std::abs(score.made_angle - least_of_other));
        ++judged;
      }
    });
    EXPECT_GT(judged, 100);
    EXPECT_GT(apart, 0.1);
  }
}

// A score is returned if and only if it reaches the bar, however early that is excluded.
TEST(RepairScore, AboveABarIsTheScoreThatReachesIt) {
  for (const auto& targets : kTargetsOfScores) {
    for (const Crs& crs : {Crs{}, wgs84()}) {
      int above = 0, below = 0;
      forEachInnerNode(targets, crs, [&](const RepairView& view, const GridPatch& patch, std::uint32_t node) {
        const PatchScale scale = scaleOf(view, patch);
        std::vector<PatchEdit> edits = movesOf(view, node);
        for (const std::uint32_t other : neighboursOf(view, node))
          if (auto edit = collapseOf(view, node, other, 0.0)) edits.push_back(std::move(*edit));
        EditScore last = scoreOf(scale);
        for (const PatchEdit& edit : edits) {
          const EditScore whole = scoreOf(view, patch, scale, edit);
          for (const double angle : {0.0, 10.0, 33.0}) {
            for (const EditScore* const best : std::array<const EditScore*, 2>{nullptr, &last}) {
              const ScoreBar bar{angle < 20.0 ? 1 : 0, angle, best};
              const auto score = scoreAbove(view, patch, scale, edit, bar);
              ASSERT_EQ(score.has_value(), whole.defects != kTurnedOver && bar.isReachedBy(whole));
              ++(score ? above : below);
              if (!score) continue;
              EXPECT_EQ(score->defects, whole.defects);
              EXPECT_EQ(score->min_angle, whole.min_angle);
              EXPECT_EQ(score->made_angle, whole.made_angle);
              EXPECT_EQ(score->replaced_angle, whole.replaced_angle);
            }
          }
          if (whole.defects != kTurnedOver) last = whole;
        }
      });
      EXPECT_GT(above, 500);
      EXPECT_GT(below, 5000);
    }
  }
}

TEST(RepairScore, NoMoveMendsWhereNoneMay) {
  for (const auto& targets : kTargetsOfScores) {
    for (const Crs& crs : {Crs{}, wgs84()}) {
      int hopeless = 0, mended = 0;
      forEachInnerNode(targets, crs, [&](const RepairView& view, const GridPatch& patch, std::uint32_t node) {
        const PatchScale scale = scaleOf(view, patch);
        const bool may = moveMayMend(view, scale, node);
        hopeless += !may;
        for (const PatchEdit& edit : movesOf(view, node)) {
          const int defects = scoreOf(view, patch, scale, edit).defects;
          mended += defects < 0;
          EXPECT_TRUE(may || defects >= 0) << node;
        }
      });
      EXPECT_GT(mended, 10);
      // Any move may separate the centres of triangles beside a node.
      if (targets[0] != Target::Dflowfm) {
        EXPECT_GT(hopeless, 10);
      }
    }
  }
}

// Depths change between two calls, as they do for nodes that repairs moved.
TEST(RepairScore, MemoryOfTheLastRepairsChangesNoResult) {
  const RepairOptions options{.time_step_s = kStep};
  std::size_t first = 0, second = 0, stuck = 0;
  for (unsigned seed = 0; seed < 100; ++seed) {
    Grid knowing = shakenSea(seed, wgs84());
    if (hasTurned(knowing)) continue;
    Grid other = knowing;
    RepairMemory memory;
    first += repairForTargets(knowing, {}, options, &memory).repairs.size();
    repairForTargets(other, {}, options);
    ASSERT_EQ(memory.stuck.size(), knowing.triangles.size());
    stuck += static_cast<std::size_t>(std::ranges::count(memory.stuck, true));
    for (std::size_t i = seed % 5; i < knowing.z.size(); i += 5) knowing.z[i] = other.z[i] = -12.0;
    const RepairReport with = repairForTargets(knowing, {}, options, &memory);
    const RepairReport without = repairForTargets(other, {}, options);
    EXPECT_EQ(with.repairs.size(), without.repairs.size());
    second += with.repairs.size();
    EXPECT_EQ(knowing.nodes, other.nodes);
    EXPECT_EQ(knowing.triangles, other.triangles);
    EXPECT_EQ(knowing.z, other.z);
    // The boundaries still cover the shore, and nothing else.
    for (const TargetDefect& defect : checkTarget(knowing, Target::Adcirc))
      EXPECT_TRUE(defect.kind != TargetDefectKind::NoBoundary && defect.kind != TargetDefectKind::StrayBoundary)
          << toString(defect.kind);
  }
  EXPECT_GT(first, 20u);
  EXPECT_GT(second, 5u);
  EXPECT_GT(stuck, 100u);
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
