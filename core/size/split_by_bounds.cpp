#include "core/size/split_by_bounds.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "core/large_list.hpp"
#include "core/size/on_surface.hpp"
#include "core/size/size_demand.hpp"

namespace coastmesh {

namespace {

// If the lower bound of sizes in a cell is smaller by this factor than the sizes at its corners, sides and centre,
// something small lies between them. Bounds of sizes that grow with a distance are off by less.
constexpr double kHidden = 1.5;
// The largest ratio of scale factors within any cell, so that integrals over it are accurate.
constexpr double kAnyStretch = 1.3;
constexpr std::size_t kCentre = 2;  // index in kOwnVertices
constexpr std::array<unsigned, 9> kOwnThenMiddles = {0, 2, 4, 6, 8, 1, 3, 5, 7};

struct Splitting {
  SizeCells& cells;
  SizeVertices& vertices;
  const SizeTreeTask& task;
  std::vector<OwnVertices> own_vertices = {kNoVertices};
  bool has_room = true;
};

// The cells of one level that will be evaluated, and what is known of them.
struct Level {
  std::vector<std::uint32_t> cells;
  std::vector<SizeBox> boxes;
  std::vector<SizeRange> ranges;
  std::vector<CellDemand> demands;
};

double toleranceOf(const SizeRange& range, const SizeTreeOptions& options) {
  return range.is_graded ? options.tolerance_graded : options.tolerance;
}

// Splits these leaves unless there would be too many cells.
void splitIfRoom(Splitting& run, std::span<const std::uint32_t> leaves) {
  if (run.cells.count() + 4 * leaves.size() > run.task.options.most_cells) {
    run.has_room = false;
    return;
  }
  splitLeaves(run.cells, leaves, run.task.loop);
  resizeOn(run.task.loop, run.own_vertices, run.cells.count(), kNoVertices);
}

// Asks for the bounds in the cells of a level; makes room for demands.
void boundLevel(Level& level, const Splitting& run) {
  const ItemLoop& loop = run.task.loop;
  const std::size_t count = level.cells.size();
  resizeAnew(loop, level.boxes, count);
  forEachByStretches(loop, count, [&](std::size_t k) { level.boxes[k] = run.cells.boxOf(level.cells[k]); });
  resizeAnew(loop, level.ranges, count);
  run.task.source.bound(level.boxes, level.ranges);
  resizeAnew(loop, level.demands, count);
}

// Cells of a level that may have to be split: their indices in it, and the numbers of their vertices in the order of
// `kOwnThenMiddles`.
struct Candidates {
  static constexpr std::size_t kEach = kOwnThenMiddles.size();

  std::vector<std::uint32_t> indices;
  BulkList<std::uint32_t> numbers;  // kEach for each
  std::uint32_t* of(std::size_t k) { return &numbers[kEach * k]; }
  const std::uint32_t* of(std::size_t k) const { return &numbers[kEach * k]; }
};

// Numbers the vertices of these cells of a level, and samples sizes there.
Candidates sampleCandidates(Splitting& run, const Level& level, std::vector<std::uint32_t>&& indices) {
  constexpr std::size_t kEach = Candidates::kEach;
  const ItemLoop& loop = run.task.loop;
  const std::size_t count = indices.size();
  Candidates all{std::move(indices), unsetList<std::uint32_t>(kEach * count)};
  const auto cellOf = [&](std::size_t k) { return level.cells[all.indices[k]]; };
  forEachByStretches(loop, count, [&](std::size_t k) {
    std::ranges::copy(run.own_vertices[cellOf(k)], all.of(k));
    std::fill_n(all.of(k) + kOwnVertices.size(), kMiddles.size(), kNone);
  });
  run.vertices.places.addAll(
      loop, [&](std::size_t i) { return run.cells.vertexOf(cellOf(i / kEach), kOwnThenMiddles[i % kEach]); },
      all.numbers);
  std::vector<double>& own = run.vertices.sizes.own;
  resizeOn(loop, own, run.vertices.places.size(), kUnasked);
  // Bounds have provided some.
  forEachByStretches(loop, count, [&](std::size_t k) {
    std::copy_n(all.of(k), kOwnVertices.size(), run.own_vertices[cellOf(k)].begin());
    const double at_centre = level.ranges[all.indices[k]].at_centre;
    if (!std::isnan(at_centre)) own[all.of(k)[kCentre]] = at_centre;
  });
  sampleNew(run.vertices, run.cells, run.task);
  return all;
}

// True if centre or sides of a cell differ from interpolation between the corners, or it contains something much
// smaller than all of these.
bool isBent(const std::array<double, 9>& v, const SizeRange& range, double side, const SizeTreeOptions& options) {
  // The error of four triangles; eight have about half of it.
  double off = std::abs(0.25 * (v[0] + v[2] + v[6] + v[8]) - v[4]);
  off = 0.5 * std::max({off, std::abs(0.5 * (v[0] + v[2]) - v[1]), std::abs(0.5 * (v[0] + v[6]) - v[3]),
                        std::abs(0.5 * (v[2] + v[8]) - v[5]), std::abs(0.5 * (v[6] + v[8]) - v[7])});
  const double least = std::ranges::min(v);
  if (least > kHidden * range.low) return true;
  return std::isfinite(off) ? off * side > toleranceOf(range, options) * least * least : std::isfinite(least);
}

// Numbers the own vertices of the children, from cell `first` on, of these candidates. Four of each child's vertices
// already have a number.
void numberChildren(Splitting& run, const Candidates& all, std::span<const std::uint32_t> split, std::size_t first) {
  const ItemLoop& loop = run.task.loop;
  std::vector<std::uint32_t> centres(4 * split.size(), kNone);
  run.vertices.places.addAll(
      loop, [&](std::size_t i) { return run.cells.vertexOf(static_cast<std::uint32_t>(first + i), 4); }, centres);
  forEachByStretches(loop, split.size(), [&](std::size_t k) {
    LeafVertices around;
    for (std::size_t i = 0; i < Candidates::kEach; ++i) around[kOwnThenMiddles[i]] = all.of(split[k])[i];
    for (std::size_t child = 0; child < 4; ++child) {
      const std::size_t corner = child % 2 + 3 * (child / 2);
      run.own_vertices[first + 4 * k + child] = {around[corner], around[corner + 1], centres[4 * k + child],
                                                 around[corner + 3], around[corner + 4]};
    }
  });
}

void splitWhereBent(Splitting& run, const Level& level, std::vector<std::uint32_t>&& indices) {
  const Candidates all = sampleCandidates(run, level, std::move(indices));
  const std::vector<std::uint32_t> bent = numbersWith(run.task.loop, 0, all.indices.size(), [&](std::uint32_t k) {
    std::array<double, 9> sizes;
    for (std::size_t i = 0; i < Candidates::kEach; ++i)
      sizes[kOwnThenMiddles[i]] = run.vertices.sizes.own[all.of(k)[i]];
    const std::uint32_t index = all.indices[k];
    const double side = longestSide(run.task.surface(), level.boxes[index]);
    return isBent(sizes, level.ranges[index], side, run.task.options);
  });
  std::vector<std::uint32_t> cells(bent.size());
  forEachByStretches(run.task.loop, bent.size(), [&](std::size_t k) { cells[k] = level.cells[all.indices[bent[k]]]; });
  const std::size_t before = run.cells.count();
  splitIfRoom(run, cells);
  if (run.has_room) numberChildren(run, all, bent, before);
}

// Splits cells that are too large for their smallest length, and those that are bent.
void splitByRange(Splitting& run, const Level& level) {
  enum class Split : std::uint8_t { No, Yes, IfBent };
  const SizeTreeOptions& options = run.task.options;
  std::vector<Split> splits(level.cells.size());
  forEachByStretches(run.task.loop, splits.size(), [&](std::size_t k) {
    const SizeRange& range = level.ranges[k];
    if (!(range.high > range.low * (1.0 + toleranceOf(range, options)))) return;
    const double side = longestSide(options.surface, level.boxes[k]);
    if (side > options.coarsest * range.low || isStretched(options.surface, level.boxes[k], kGradedStretch)) {
      splits[k] = Split::Yes;
    } else if (side > (range.is_graded ? options.finest_graded : options.finest) * range.low) {
      splits[k] = Split::IfBent;
    }
  });
  splitIfRoom(run, listOver<std::uint32_t>(run.task.loop, splits.size(), [&](std::size_t k, auto& list) {
                if (splits[k] == Split::Yes) list.push_back(level.cells[k]);
              }));
  if (!run.has_room) return;
  splitWhereBent(run, level, numbersWith(run.task.loop, 0, splits.size(), [&](std::uint32_t k) {
                   return splits[k] == Split::IfBent;
                 }));
}

SizeDemand excessOf(const DemandSum& demand) {
  return {std::max(demand.likely, demand.least), demand.most_in, demand.size};
}

// Splits all levels. Returns the demand if it gives up.
std::optional<SizeDemand> splitLevels(Splitting& run) {
  // A few more cells cost nothing and improve the estimate.
  constexpr std::size_t kFewCells = 20'000;
  SizeCells& cells = run.cells;
  const SizeTreeTask& task = run.task;
  DemandLimit limit(task.options.most_vertices);
  Level level;
  DemandSum settled;  // of cells that are not split
  for (std::size_t l = 0, first = 0; l < SizeCells::kLevels; ++l) {
    const std::size_t end = cells.count();
    if (task.surface().isCurved()) {
      splitIfRoom(run, numbersWith(task.loop, first, end, [&](std::uint32_t c) {
                    return isStretched(task.surface(), cells.boxOf(c), kAnyStretch);
                  }));
    }
    level.cells = numbersWith(task.loop, first, end,
                              [&](std::uint32_t c) { return cells.isLeaf(c) && task.source.isWanted(cells.boxOf(c)); });
    if (run.has_room && level.cells.empty() && cells.count() == end) break;
    boundLevel(level, run);
    DemandSum pending = sumOver(task.loop, level.cells.size(), settled, [&](DemandSum& sum, std::size_t k) {
      level.demands[k] = demandIn(level.boxes[k], level.ranges[k], task);
      sum.add(level.demands[k], level.boxes[k]);
    });
    limit.see(pending);
    // Bounds alone reveal a slight excess only when the tree is nearly complete.
    if (limit.isExceededOnAverage() && end >= kFewCells) {
      pending.least = std::max(pending.least, pending.central);
      return excessOf(pending);
    }
    if (limit.isExceeded() && end >= kFewCells) return excessOf(pending);
    if (run.has_room) splitByRange(run, level);
    if (!run.has_room) return excessOf(pending);
    settled = sumOver(task.loop, level.cells.size(), settled, [&](DemandSum& sum, std::size_t k) {
      if (cells.isLeaf(level.cells[k])) sum.add(level.demands[k], level.boxes[k]);
    });
    first = end;
  }
  return limit.isExceeded() ? std::optional(excessOf(settled)) : std::nullopt;
}

}  // namespace

SplitByBounds splitByBounds(SizeCells& cells, SizeVertices& vertices, const SizeTreeTask& task) {
  Splitting run{cells, vertices, task};
  const std::optional<SizeDemand> excess = splitLevels(run);
  return {std::move(run.own_vertices), excess};
}

}  // namespace coastmesh
