#include "parallel/partition.hpp"

#include <oneapi/tbb/parallel_invoke.h>
#include <oneapi/tbb/parallel_sort.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "core/metric.hpp"

namespace coastmesh {

namespace {

// A triangle's centroid in the turned frame.
struct Sample {
  std::array<double, 2> at;
  double weight;
};

// The weight comes last, so that the order does not depend on how the sort divides its work.
void sortAlong(unsigned axis, std::span<Sample> samples) {
  constexpr std::size_t kWorthThreads = 4096;
  const auto isBefore = [axis](const Sample& s, const Sample& t) {
    return std::tuple(s.at[axis], s.at[1 - axis], s.weight) < std::tuple(t.at[axis], t.at[1 - axis], t.weight);
  };
  if (samples.size() < kWorthThreads) {
    std::ranges::sort(samples, isBefore);
  } else {
    tbb::parallel_sort(samples.begin(), samples.end(), isBefore);
  }
}

// Builds the tree of cuts, splitting samples.
class CutTreeBuilder {
 public:
  explicit CutTreeBuilder(std::vector<CutTree::Node>& nodes) : nodes_(nodes) {}

  // Builds the subtree that makes `pieces` pieces, numbered from `first`, in `node` and the 2 * pieces - 2 nodes behind
  // it.
  void split(std::uint32_t node, std::span<Sample> samples, PieceId first, PieceId pieces) {
    nodes_[node].piece = first;
    if (pieces == 1 || samples.size() < 2) return;
    std::array<double, 2> low = samples.front().at, high = low;
    double whole = 0.0;
    for (const Sample& s : samples) {
      whole += s.weight;
      for (unsigned axis = 0; axis < 2; ++axis) {
        low[axis] = std::min(low[axis], s.at[axis]);
        high[axis] = std::max(high[axis], s.at[axis]);
      }
    }
    const unsigned axis = high[0] - low[0] >= high[1] - low[1] ? 0 : 1;
    sortAlong(axis, samples);
    const PieceId lower = pieces / 2;
    const double share = whole * lower / pieces;
    std::size_t middle = 0;
    for (double sum = 0.0; middle + 1 < samples.size() && sum < share; ++middle) sum += samples[middle].weight;
    const std::uint32_t left = node + 1, right = node + 2 * lower;
    nodes_[node] = {axis, samples[middle].at[axis], {left, right}, first, false};
    tbb::parallel_invoke([&] { split(left, samples.first(middle), first, lower); },
                         [&] { split(right, samples.subspan(middle), first + lower, pieces - lower); });
  }

 private:
  std::vector<CutTree::Node>& nodes_;
};

Point centroidOf(const TriMesh& mesh, TriId t) {
  const auto& v = mesh.triangle(t).v;
  return centroid(mesh.point(v[0]), mesh.point(v[1]), mesh.point(v[2]));
}

// Sorts triangles by piece. `triangle(i)` is the i-th of `count`.
template <typename Triangle>
void sortByPiece(Partition& partition, std::size_t count, const Triangle& triangle, Recorder& recorder) {
  constexpr std::size_t kStretches = 64;
  const auto begin = [&](std::size_t stretch) { return count * stretch / kStretches; };
  std::vector<std::vector<std::size_t>> counts(kStretches);
  recorder.forEach("cut", kStretches, {}, [&](std::size_t s) {
    counts[s].assign(partition.pieces, 0);
    for (std::size_t i = begin(s); i < begin(s + 1); ++i) ++counts[s][partition.piece_of[triangle(i)]];
  });
  partition.first.assign(partition.pieces + 1, 0);
  std::size_t sum = 0;
  for (PieceId p = 0; p < partition.pieces; ++p) {
    partition.first[p] = sum;
    for (std::vector<std::size_t>& of_stretch : counts) sum += std::exchange(of_stretch[p], sum);
  }
  partition.first[partition.pieces] = sum;
  resizeAnew(recorder.loop("cut"), partition.triangles, count);
  resizeAnew(recorder.loop("cut"), partition.slot_of, partition.piece_of.size());
  recorder.forEach("cut", kStretches, {}, [&](std::size_t s) {
    for (std::size_t i = begin(s); i < begin(s + 1); ++i) {
      const TriId t = triangle(i);
      const PieceId p = partition.piece_of[t];
      const std::size_t place = counts[s][p]++;
      partition.triangles[place] = t;
      partition.slot_of[t] = static_cast<TriId>(place - partition.first[p]);
    }
  });
}

}  // namespace

PieceId CutTree::pieceAt(const std::array<double, 2>& turned) const {
  std::uint32_t i = 0;
  while (!nodes[i].leaf) i = nodes[i].below[turned[nodes[i].axis] < nodes[i].cut ? 0 : 1];
  return nodes[i].piece;
}

std::array<double, 2> CutTree::turn(const Point& p) const {
  return {cosine * p.x + sine * p.y, cosine * p.y - sine * p.x};
}

void partition(const TriMesh& mesh, std::span<const TriId> some, PieceId pieces, double angle,
               const std::function<double(TriId)>& weight, Recorder& recorder, Partition& parts) {
  CutTree tree{std::cos(angle), std::sin(angle), std::vector<CutTree::Node>(2 * pieces - 1)};
  const auto centre = [&](TriId t) { return tree.turn(centroidOf(mesh, t)); };
  // Enough samples per piece that weights differ little; sorting all triangles would take longer than meshing them.
  constexpr std::size_t kSamples = 128;
  const std::size_t count = some.empty() ? mesh.triangles.size() : some.size();
  const auto triangle = [&](std::size_t i) { return some.empty() ? static_cast<TriId>(i) : some[i]; };
  const std::size_t stride = std::max<std::size_t>(1, count / (kSamples * pieces));
  std::vector<Sample> samples((count + stride - 1) / stride);
  const ItemLoop loop = recorder.loop("cut");
  forEachByStretches(loop, samples.size(), [&](std::size_t i) {
    const TriId t = triangle(i * stride);
    samples[i] = {centre(t), weight(t)};
  });
  CutTreeBuilder(tree.nodes).split(0, samples, 0, pieces);

  parts.pieces = pieces;
  resizeAnew(loop, parts.piece_of, mesh.triangles.size());
  if (!some.empty()) forEachByStretches(loop, parts.piece_of.size(), [&](std::size_t t) { parts.piece_of[t] = kNone; });
  forEachByStretches(loop, count, [&](std::size_t i) {
    const TriId t = triangle(i);
    parts.piece_of[t] = tree.pieceAt(centre(t));
  });
  sortByPiece(parts, count, triangle, recorder);
  parts.tree = std::move(tree);
}

std::vector<PieceId> piecesOf(const TriMesh& mesh, const CutTree& tree, const ItemLoop& loop) {
  std::vector<PieceId> pieces(mesh.triangles.size(), 0);
  if (tree.nodes.empty()) return pieces;
  forEachByStretches(loop, pieces.size(), [&](std::size_t t) {
    pieces[t] = tree.pieceAt(tree.turn(centroidOf(mesh, static_cast<TriId>(t))));
  });
  return pieces;
}

}  // namespace coastmesh
