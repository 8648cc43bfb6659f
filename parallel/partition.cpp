#include "parallel/partition.hpp"

#include <oneapi/tbb/parallel_invoke.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/metric.hpp"

namespace coastmesh {

namespace {

// A triangle's centroid in the turned frame.
struct Sample {
  std::array<double, 2> at;
  double weight;
};

// A tree of cuts: node i has its children at those of `below`; a leaf has its piece in `piece`.
struct Node {
  unsigned axis = 0;
  double cut = 0.0;
  std::array<std::uint32_t, 2> below{};
  PieceId piece = 0;
  bool leaf = true;
};

class CutTree {
 public:
  CutTree(std::vector<Sample> samples, PieceId pieces) : samples_(std::move(samples)), nodes_(2 * pieces - 1) {
    split(0, samples_, 0, pieces);
  }

  PieceId pieceAt(const std::array<double, 2>& at) const {
    std::uint32_t i = 0;
    while (!nodes_[i].leaf) i = nodes_[i].below[at[nodes_[i].axis] < nodes_[i].cut ? 0 : 1];
    return nodes_[i].piece;
  }

 private:
  // Node `node` and the 2 pieces - 2 behind it in the array make pieces `first`, `first` + 1, and so on.
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
    std::ranges::sort(samples, {}, [axis](const Sample& s) { return std::pair(s.at[axis], s.at[1 - axis]); });
    const PieceId lower = pieces / 2;
    const double share = whole * lower / pieces;
    std::size_t middle = 0;
    for (double sum = 0.0; middle + 1 < samples.size() && sum < share; ++middle) sum += samples[middle].weight;
    const std::uint32_t left = node + 1, right = node + 2 * lower;
    nodes_[node] = {axis, samples[middle].at[axis], {left, right}, first, false};
    tbb::parallel_invoke([&] { split(left, samples.first(middle), first, lower); },
                         [&] { split(right, samples.subspan(middle), first + lower, pieces - lower); });
  }

  std::vector<Sample> samples_;
  std::vector<Node> nodes_;
};

// The triangles in the order of their pieces.
void sortByPiece(Partition& partition, Recorder& recorder) {
  constexpr std::size_t kStretches = 64;
  const std::size_t count = partition.piece_of.size();
  const auto begin = [&](std::size_t stretch) { return count * stretch / kStretches; };
  std::vector<std::vector<std::size_t>> counts(kStretches);
  recorder.forEach("cut", kStretches, {}, [&](std::size_t s) {
    counts[s].assign(partition.pieces, 0);
    for (std::size_t t = begin(s); t < begin(s + 1); ++t) ++counts[s][partition.piece_of[t]];
  });
  partition.first.assign(partition.pieces + 1, 0);
  std::size_t sum = 0;
  for (PieceId p = 0; p < partition.pieces; ++p) {
    partition.first[p] = sum;
    for (std::vector<std::size_t>& of_stretch : counts) sum += std::exchange(of_stretch[p], sum);
  }
  partition.first[partition.pieces] = sum;
  reserveOn(recorder.loop("cut"), partition.triangles, count);
  reserveOn(recorder.loop("cut"), partition.slot_of, count);
  partition.triangles.resize(count);
  partition.slot_of.resize(count);
  recorder.forEach("cut", kStretches, {}, [&](std::size_t s) {
    for (std::size_t t = begin(s); t < begin(s + 1); ++t) {
      const PieceId p = partition.piece_of[t];
      const std::size_t place = counts[s][p]++;
      partition.triangles[place] = static_cast<TriId>(t);
      partition.slot_of[t] = static_cast<TriId>(place - partition.first[p]);
    }
  });
}

}  // namespace

Partition partition(const TriMesh& mesh, PieceId pieces, double angle, const std::function<double(TriId)>& weight,
                    Recorder& recorder, Partition&& reused) {
  const double cosine = std::cos(angle), sine = std::sin(angle);
  const auto centre = [&](TriId t) -> std::array<double, 2> {
    const auto& v = mesh.triangle(t).v;
    const Point c = mesh.point(v[0]) + mesh.point(v[1]) + mesh.point(v[2]);
    return {cosine * c.x + sine * c.y, cosine * c.y - sine * c.x};
  };
  // Enough samples a piece that their weights differ little; all triangles would take longer to sort than to mesh.
  constexpr std::size_t kSamples = 128;
  const std::size_t count = mesh.triangles.size();
  const std::size_t stride = std::max<std::size_t>(1, count / (kSamples * pieces));
  std::vector<Sample> samples((count + stride - 1) / stride);
  const ItemLoop loop = recorder.loop("cut");
  forEachByStretches(loop, samples.size(), [&](std::size_t i) {
    const auto t = static_cast<TriId>(i * stride);
    samples[i] = {centre(t), weight(t)};
  });
  const CutTree tree(std::move(samples), pieces);

  Partition result = std::move(reused);
  result.pieces = pieces;
  reserveOn(loop, result.piece_of, count);
  result.piece_of.resize(count);
  forEachByStretches(loop, count,
                     [&](std::size_t t) { result.piece_of[t] = tree.pieceAt(centre(static_cast<TriId>(t))); });
  sortByPiece(result, recorder);
  return result;
}

}  // namespace coastmesh
