#include "gis/follow/passage_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/metric.hpp"
#include "gis/follow/line_samples.hpp"

namespace coastmesh {

namespace {

// Elements beside the passage that have its size; from there sizes grow by the distance.
constexpr double kBeside = 1.0;

}  // namespace

PassageSizes::PassageSizes(const SizeFunction& size, const std::vector<ShoreLine>& passages,
                           const ShoreTriangles& triangles)
    : size_(size) {
  std::vector<std::vector<LineSample>> sampled;
  for (const ShoreLine& line : passages) sampled.push_back(samplesOf(line.points, size));
  locateSamples(sampled, elementsOf(passages), triangles);
  std::vector<Box> boxes;
  for (std::size_t line = 0; line < passages.size(); ++line) {
    const std::vector<LineSample>& samples = sampled[line];
    for (const LandOnLine& land : landsOn(samples)) {
      if (land.at_end || samples[land.first].beyond) continue;
      const LineSample &before = samples[land.first - 1], &after = samples[land.last + 1];
      const auto sizeAt = [&](const LineSample& sample) {
        const double share = (sample.way - before.way) / (after.way - before.way);
        return std::min(sample.size, before.size + share * (after.size - before.size));
      };
      for (std::size_t i = land.first - 1; i <= land.last; ++i) {
        const LineSample &a = samples[i], &b = samples[i + 1];
        pieces_.push_back({a.at, b.at, sizeAt(a), sizeAt(b), passages[line].elements});
        const double most = std::max(a.size, b.size);
        boxes.push_back(Box::of(a.at, b.at).grownBy((0.5 * passages[line].elements + kBeside + 1.0) * most));
      }
    }
  }
  if (!boxes.empty()) tree_ = BoxTree(boxes, BoxTree::Order::Hilbert);
}

double PassageSizes::mostAt(const Point& x) const {
  double most = std::numeric_limits<double>::infinity();
  tree_.visit(Box::of(x, x), [&](std::uint32_t item) {
    const auto& [a, b, size_a, size_b, elements] = pieces_[item];
    const double share = shareAlongSegment(x, a, b);
    const double size = size_a + share * (size_b - size_a);
    const double off = std::sqrt(squaredDistanceToSegment(x, a, b)) - (0.5 * elements + kBeside) * size;
    most = std::min(most, size + std::max(0.0, off));
  });
  return most;
}

double PassageSizes::at(const Point& x) const { return std::min(size_.at(x), mostAt(x)); }

void PassageSizes::sample(std::span<const Point> places, std::span<double> sizes) const {
  size_.sample(places, sizes);
  for (std::size_t i = 0; i < places.size() && !pieces_.empty(); ++i) sizes[i] = std::min(sizes[i], mostAt(places[i]));
}

void PassageSizes::measure(ShoreTriangles& triangles) const {
  if (pieces_.empty()) return;
  for (std::size_t v = 0; v < triangles.size_at.size(); ++v)
    triangles.size_at[v] = std::min(triangles.size_at[v], mostAt(triangles.mesh.points[v]));
  for (TriId t = 0; t < triangles.mesh.triangles.size(); ++t) {
    const auto& v = triangles.mesh.triangles[t].v;
    const Point centre = centroid(triangles.mesh.point(v[0]), triangles.mesh.point(v[1]), triangles.mesh.point(v[2]));
    if (mostAt(centre) < triangles.size[t]) measureTriangle(triangles, t, *this);
  }
}

}  // namespace coastmesh
