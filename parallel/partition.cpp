#include "parallel/partition.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <utility>

#include "core/bulk_list.hpp"
#include "core/distribute.hpp"
#include "core/metric.hpp"

namespace coastmesh {

namespace {

// A triangle's centroid in the turned frame: its coordinates along an axis and along the other one. The weight comes
// last, so that equal samples are identical.
struct Sample {
  double along, across, weight;

  friend auto operator<=>(const Sample&, const Sample&) = default;
};

Sample turned(const Sample& s) { return {s.across, s.along, s.weight}; }

// Sorts samples of which equal ones are identical: divides them at the quantiles of a few first, since merging sorted
// ranges would end on one thread.
void sortByParts(const ItemLoop& loop, std::vector<Sample>& samples) {
  constexpr std::size_t kParts = 64, kFewOfAPart = 16, kFew = kParts * kFewOfAPart;
  if (samples.size() < 4 * kFew) {
    std::ranges::sort(samples);
    return;
  }
  std::vector<Sample> few(kFew), bounds(kParts - 1);
  for (std::size_t i = 0; i < kFew; ++i) few[i] = samples[samples.size() * i / kFew];
  std::ranges::sort(few);
  for (std::size_t p = 1; p < kParts; ++p) bounds[p - 1] = few[p * kFewOfAPart];
  const Distribution by_part = distribute(loop, samples.size(), kParts, [&](std::size_t i) {
    return std::ranges::upper_bound(bounds, samples[i]) - bounds.begin();
  });
  std::vector<Sample> sorted(samples.size());
  loop(kParts, [&](std::size_t p) {
    const std::size_t begin = by_part.starts[p], end = by_part.starts[p + 1];
    for (std::size_t i = begin; i < end; ++i) sorted[i] = samples[by_part.items[i]];
    std::ranges::sort(std::span(sorted).subspan(begin, end - begin));
  });
  samples = std::move(sorted);
}

// Builds the tree of cuts. Samples are sorted once along each axis; splitting keeps both orders.
class CutTreeBuilder {
 public:
  // `samples` are along axis 0.
  CutTreeBuilder(const std::vector<Sample>& samples, std::vector<CutTree::Node>& nodes, const ItemLoop& loop)
      : samples_(samples), nodes_(nodes), loop_(loop), beside_(samples.size()) {
    sorted_.fill(samples);
    forEachByStretches(loop, samples.size(), [this](std::size_t i) { sorted_[1][i] = turned(sorted_[0][i]); });
    for (std::vector<Sample>& sorted : sorted_) sortByParts(loop, sorted);
  }

  void build(PieceId pieces) {
    std::vector<Part> level{{0, 0, samples_.size(), 0, pieces, samples_}};
    while (!level.empty()) {
      std::vector<std::vector<Part>> below(level.size());
      loop_(level.size(), [&](std::size_t i) { below[i] = split(level[i]); });
      level = joined(std::move(below));
    }
  }

 private:
  // The subtree that makes `pieces` pieces, numbered from `first`, in `node` and the 2 * pieces - 2 nodes behind it.
  struct Part {
    std::uint32_t node;
    std::size_t begin, end;  // of its samples
    PieceId first, pieces;
    std::span<const Sample> order;  // in which their weights are added up: that along the axis of the last cut
  };

  // Returns the parts below that are still to be split: small ones are split at once.
  std::vector<Part> split(const Part& part) {
    constexpr std::size_t kWorthThreads = 4096;
    const auto& [node, begin, end, first, pieces, order] = part;
    nodes_[node].piece = first;
    if (pieces == 1 || end - begin < 2) return {};
    double whole = 0.0;
    for (const Sample& s : order.subspan(begin, end - begin)) whole += s.weight;
    const auto extent = [&](unsigned axis) { return sorted_[axis][end - 1].along - sorted_[axis][begin].along; };
    const unsigned axis = extent(0) >= extent(1) ? 0 : 1;
    const std::vector<Sample>& sorted = sorted_[axis];
    const PieceId lower = pieces / 2;
    const double share = whole * lower / pieces;
    std::size_t middle = begin;
    for (double sum = 0.0; middle + 1 < end && sum < share; ++middle) sum += sorted[middle].weight;
    const std::uint32_t left = node + 1, right = node + 2 * lower;
    nodes_[node] = {axis, sorted[middle].along, {left, right}, first, false};
    divide(sorted_[1 - axis], sorted, begin, middle, end);
    const std::array below{Part{left, begin, middle, first, lower, sorted},
                           Part{right, middle, end, first + lower, pieces - lower, sorted}};
    if (end - begin > kWorthThreads) return {below[0], below[1]};
    for (const Part& each : below) split(each);
    return {};
  }

  // Moves the samples that `sorted` has before `middle` to the front of `other`, which has the same ones.
  void divide(std::vector<Sample>& other, const std::vector<Sample>& sorted, std::size_t begin, std::size_t middle,
              std::size_t end) {
    const Sample pivot = sorted[middle];
    std::size_t equal_before = 0;
    while (middle - equal_before > begin && sorted[middle - equal_before - 1] == pivot) ++equal_before;
    std::size_t front = begin, back = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const Sample sample = turned(other[i]);
      const bool is_equal = sample == pivot;
      if (is_equal ? equal_before > 0 : sample < pivot) {
        if (is_equal) --equal_before;
        other[front++] = other[i];
      } else {
        beside_[begin + back++] = other[i];
      }
    }
    std::copy_n(beside_.begin() + static_cast<std::ptrdiff_t>(begin), back,
                other.begin() + static_cast<std::ptrdiff_t>(front));
  }

  const std::vector<Sample>& samples_;
  std::vector<CutTree::Node>& nodes_;
  const ItemLoop& loop_;
  std::array<std::vector<Sample>, 2> sorted_;  // along each axis
  std::vector<Sample> beside_;
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
    const auto [x, y] = centre(t);
    samples[i] = {x, y, weight(t)};
  });
  CutTreeBuilder(samples, tree.nodes, loop).build(pieces);

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
