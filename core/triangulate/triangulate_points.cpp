#include "core/triangulate/triangulate_points.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/bulk_list.hpp"
#include "core/distribute.hpp"
#include "core/hilbert.hpp"
#include "core/large_list.hpp"
#include "core/triangulate/insert_points.hpp"
#include "core/triangulate/merge_halves.hpp"

namespace coastmesh {

namespace {

// Fewer points to a part cost more merging than they save by staying in the processor's cache.
constexpr std::size_t kPointsInPart = 8192;
constexpr std::size_t kMostParts = 1024;

std::size_t partsFor(std::size_t points) {
  return std::min(kMostParts, std::bit_floor(std::max<std::size_t>(1, points / kPointsInPart)));
}

// Nodes of a complete binary tree, from 1 for the root; those of level k are 2^k to 2^(k + 1) - 1. The last level are
// the parts.
struct PartTree {
  std::size_t parts = 1;
  std::vector<Point> cut;             // of the inner nodes: points before it belong to the first child
  std::vector<std::uint32_t> starts;  // of the parts in `along`, then its end
  BulkList<VertexId> along;           // the points by part, in each along the curve
};

// Every other level cuts in the other direction.
Sweep sweepAt(std::size_t node) { return std::bit_width(node) % 2 == 1 ? Sweep::Right : Sweep::Up; }

// Cuts at the medians of a sample.
void cutSample(std::span<const Point> points, std::span<VertexId> sample, std::size_t node, PartTree& tree) {
  if (node >= tree.parts) return;
  const Sweep sweep = sweepAt(node);
  const auto middle = sample.begin() + static_cast<std::ptrdiff_t>(sample.size() / 2);
  std::ranges::nth_element(sample, middle,
                           [&](VertexId a, VertexId b) { return isBefore(sweep, points[a], points[b]); });
  tree.cut[node] = points[*middle];
  cutSample(points, {sample.begin(), middle}, 2 * node, tree);
  cutSample(points, {middle, sample.end()}, 2 * node + 1, tree);
}

std::size_t partOf(const Point& p, const PartTree& tree) {
  std::size_t node = 1;
  while (node < tree.parts) node = 2 * node + (isBefore(sweepAt(node), p, tree.cut[node]) ? 0 : 1);
  return node - tree.parts;
}

PartTree divide(std::span<const Point> points, std::span<const VertexId> along_curve, const ItemLoop& loop) {
  constexpr std::size_t kSampledOf = 32;
  PartTree tree;
  tree.parts = partsFor(points.size());
  std::vector<VertexId> sample;
  for (std::size_t i = 0; i < along_curve.size(); i += kSampledOf) sample.push_back(along_curve[i]);
  tree.cut.resize(tree.parts);
  cutSample(points, sample, 1, tree);

  Distribution sorted =
      distribute(loop, points.size(), tree.parts, [&](std::size_t i) { return partOf(points[along_curve[i]], tree); });
  forEachByStretches(loop, points.size(), [&](std::size_t i) { sorted.items[i] = along_curve[sorted.items[i]]; });
  tree.along = std::move(sorted.items);
  tree.starts = std::move(sorted.starts);
  return tree;
}

class PartMerger {
 public:
  PartMerger(Triangulation& triangulation, PartTree tree)
      : all_(triangulation), tree_(std::move(tree)), ghosts_(2 * tree_.parts, kNone), twins_(2 * tree_.parts, kNone) {}

  // False if all points are on one line.
  bool run(const ItemLoop& loop) {
    loop(tree_.parts, [&](std::size_t p) { insert(tree_.parts + p, p, p + 1); });
    for (std::size_t level = tree_.parts / 2; level > 0; level /= 2) {
      refuseTwins();
      loop(level, [&](std::size_t i) { merge(level + i, tree_.parts / level); });
    }
    refuseTwins();
    return ghosts_[1] != kNone;
  }

 private:
  // The slots of a node follow one another from twice the number of points before it; its last two remain free, for
  // the merge with the node that follows.
  TriId slotOf(std::size_t part) const { return static_cast<TriId>(2 * tree_.starts[part]); }

  void insert(std::size_t node, std::size_t first_part, std::size_t last_part) {
    const std::size_t first = tree_.starts[first_part], last = tree_.starts[last_part];
    const std::span<const VertexId> points = std::span(tree_.along).subspan(first, last - first);
    try {
      ghosts_[node] = insertPoints(all_, points, slotOf(first_part));
    } catch (const Clash& clash) {
      twins_[node] = clash.at;
    }
  }

  void merge(std::size_t node, std::size_t parts) {
    const std::size_t first = node * parts - tree_.parts;
    const TriId one = ghosts_[2 * node], other = ghosts_[2 * node + 1];
    if (one == kNone || other == kNone) return insert(node, first, first + parts);
    const TriId next = slotOf(first + parts / 2);
    ghosts_[node] = mergeHalves(all_, sweepAt(node), one, other, {next - 2, next - 1});
  }

  // Several parts may have coinciding points; the same ones are reported whatever part was first.
  void refuseTwins() const {
    for (const VertexId v : twins_)
      if (v != kNone) throw Clash(Clash::Kind::PointsCoincide, v, kNone);
  }

  Triangulation& all_;
  const PartTree tree_;
  // By node.
  std::vector<TriId> ghosts_;
  std::vector<VertexId> twins_;  // a vertex in the same place as another of the node
};

}  // namespace

Triangulation triangulatePoints(std::span<const Point> points, const Surface& surface, const ItemLoop& loop) {
  Triangulation all;
  all.points = points;
  all.ghost = static_cast<VertexId>(points.size());
  all.along_curve = hilbertOrder(points, surface, loop);
  all.triangle_of = noNumbers(loop, points.size() + 1);
  resizeUnset(all.mesh.triangles, 2 * points.size());
  const bool has_triangles = partsFor(points.size()) == 1
                                 ? insertPoints(all, all.along_curve, 0) != kNone
                                 : PartMerger(all, divide(points, all.along_curve, loop)).run(loop);
  all.mesh.triangles.resize(has_triangles ? 2 * points.size() - 2 : 0);
  return all;
}

}  // namespace coastmesh
