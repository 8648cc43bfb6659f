#include "core/size/grade_leaves.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/large_list.hpp"
#include "core/metric.hpp"
#include "core/size/on_surface.hpp"
#include "core/size/size_grading.hpp"

namespace coastmesh {

namespace {

// Margin for rounding in comparisons of slopes.
constexpr double kSafely = 1.0 - 1e-6;

struct Grading {
  SizeCells& cells;
  const SizeVertices& vertices;
  const SizeTreeTask& task;
  bool has_room = true;
};

// A leaf to be split, and the vertices from which sizes grow into it.
struct DueLeaf {
  std::uint32_t leaf;
  std::array<std::uint32_t, 9> sources;
  std::size_t count = 0;
  std::span<const std::uint32_t> known() const { return std::span(sources).first(count); }
};

bool isTooLarge(const Grading& run, std::uint32_t c, std::span<const std::uint32_t> sources) {
  const SizeTreeOptions& options = run.task.options;
  const SizeCells& cells = run.cells;
  const Surface& surface = options.surface;
  const SizeCells::Square& square = cells.squares[c];
  const double half = 0.5 * cells.unit * square.side();
  const Point centre{cells.unit * square.x + half, cells.unit * square.y + half};
  double low = std::numeric_limits<double>::infinity();
  for (const std::uint32_t s : sources) {
    const SizePlaces::Place& place = run.vertices.places[s];
    const Point off = Point{cells.unit * place.x, cells.unit * place.y} - centre;
    const Point beyond{std::max(std::abs(off.x) - half, 0.0), std::max(std::abs(off.y) - half, 0.0)};
    double way = std::sqrt(squaredLength(beyond));
    if (surface.isCurved()) {
      const Point at = cells.origin + centre + off;
      const Point nearest =
          cells.origin + centre + Point{std::clamp(off.x, -half, half), std::clamp(off.y, -half, half)};
      way = arcBetween(surface, at, nearest);
    }
    low = std::min(low, run.vertices.sizes.own[s] + kSizeGrowth * options.gradation * way);
  }
  return longestSide(surface, cells.boxOf(c)) > options.coarsest * low;
}

// True if a leaf is too large for the sizes that grow into it, or too stretched. Leaves that will not be evaluated are
// split only for the latter, since sizes grow through them too.
bool isDue(const Grading& run, std::uint32_t c, std::span<const std::uint32_t> sources, bool is_wanted) {
  if (run.cells.level(c) == SizeCells::kLevels) return false;
  return (is_wanted && isTooLarge(run, c, sources)) ||
         isStretched(run.task.surface(), run.cells.boxOf(c), kGradedStretch);
}

void splitBelow(Grading& run, std::uint32_t c, std::span<const std::uint32_t> sources, bool is_wanted) {
  if (!isDue(run, c, sources, is_wanted)) return;
  if (run.cells.count() + 4 > run.task.options.most_cells) run.has_room = false;
  if (!run.has_room) return;
  splitNumbered(run.cells, c);
  for (std::uint32_t k = 0; k < 4; ++k) splitBelow(run, run.cells.below(c) + k, sources, is_wanted);
}

void splitDue(Grading& run, const SizeLeaves& leaves) {
  const std::vector<std::uint32_t>& source = run.vertices.sizes.source;
  const auto due = listOver<DueLeaf>(run.task.loop, leaves.count(), [&](std::size_t l, std::vector<DueLeaf>& list) {
    if (!leaves.is_wanted[l] && !run.task.surface().isCurved()) return;
    DueLeaf one{static_cast<std::uint32_t>(l), {}};
    for (const std::uint32_t v : leaves.vertices[l])
      if (v != kNone && source[v] != kNone) one.sources[one.count++] = source[v];
    if (one.count > 0 && isDue(run, run.cells.leaf_cells[l], one.known(), leaves.is_wanted[l] != 0))
      list.push_back(one);
  });
  for (const DueLeaf& one : due)
    splitBelow(run, run.cells.leaf_cells[one.leaf], one.known(), leaves.is_wanted[one.leaf] != 0);
}

}  // namespace

bool gradeLeaves(SizeCells& cells, SizeVertices& vertices, SizeLeaves& leaves, const SizeTreeTask& task) {
  const Surface& surface = task.surface();
  const SizeGrid grid{vertices.places, cells.unit, cells.origin, surface, kSafely * task.options.gradation};
  SizeGrading grading(vertices.sizes, grid, leaves.vertices, task.loop);
  Grading run{cells, vertices, task};
  for (int round = 0; round < SizeCells::kLevels; ++round) {
    grading.spread();
    const std::size_t before = cells.count();
    splitDue(run, leaves);
    if (cells.count() == before) break;
    balanceNumbered(cells, before, task.loop);
    const std::vector<std::uint32_t> changed = addNewLeaves(leaves, cells, before, vertices, task);
    grading.update(leaves.vertices, changed);
  }
  // If no size is requested anywhere: as large as the whole.
  const double side = cells.rootSide();
  const double whole = surface.isCurved() ? std::min(side, 2.0 * surface.radius()) : side;
  for (double& size : vertices.sizes.size) size = std::min(size, whole);
  grading.flatten();
  return run.has_room;
}

}  // namespace coastmesh
