#include "gis/follow/line_samples.hpp"

#include <algorithm>
#include <utility>

#include "core/metric.hpp"
#include "core/predicates.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/geometry/chain_index.hpp"

namespace coastmesh {

namespace {

constexpr double kStep = 0.25;        // between samples of a line, in sizes wanted
constexpr double kMostSamples = 1e6;  // of a segment of a line

// Marks land that is reached across an open boundary.
void markBeyond(std::vector<std::vector<LineSample>>& lines, const ShoreTriangles& t) {
  struct End {
    std::size_t line, wet, dry;
  };
  std::vector<End> ends;
  std::vector<Box> boxes;
  for (std::size_t line = 0; line < lines.size(); ++line) {
    const std::vector<LineSample>& samples = lines[line];
    for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
      if (isWet(samples[i]) == isWet(samples[i + 1])) continue;
      ends.push_back(isWet(samples[i]) ? End{line, i, i + 1} : End{line, i + 1, i});
      boxes.push_back(Box::of(samples[i].at, samples[i + 1].at));
    }
  }
  if (ends.empty()) return;
  const BoxTree tree(boxes, BoxTree::Order::Hilbert);
  for (TriId i = 0; i < t.mesh.triangles.size(); ++i) {
    if (t.mesh.regions[i] == t.land) continue;
    for (unsigned k = 0; k < 3; ++k) {
      const EdgeRef e = edgeRef(i, k);
      const SegmentId s = t.mesh.segment(e);
      if (s == kNone || !isOpenTag(t.tags[s])) continue;
      const Point &a = t.mesh.point(t.mesh.origin(e)), &b = t.mesh.point(t.mesh.target(e));
      tree.visit(Box::of(a, b), [&](std::uint32_t item) {
        const auto& [line, wet, dry] = ends[item];
        std::vector<LineSample>& samples = lines[line];
        if (!segmentsMeet(a, b, samples[wet].at, samples[dry].at)) return;
        const bool forwards = dry > wet;
        for (std::size_t j = dry; j < samples.size() && !isWet(samples[j]); j += forwards ? 1 : -1)
          samples[j].beyond = true;
      });
    }
  }
}

}  // namespace

bool isIn(const Point& x, const Point& a, const Point& b, const Point& c) {
  return orient2d(a, b, x) >= 0 && orient2d(b, c, x) >= 0 && orient2d(c, a, x) >= 0;
}

std::vector<LineSample> samplesOf(const std::vector<Point>& line, const SizeFunction& size) {
  std::vector<LineSample> samples;
  double way = 0.0;
  const auto add = [&](const Point& p) { samples.push_back({p, size.at(p), way}); };
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Point &a = line[i], &b = line[i + 1];
    const double length = distance(a, b), before = way;
    if (length == 0.0) continue;
    if (samples.empty()) add(a);
    const double least = length / kMostSamples;
    for (double t = std::max(least, kStep * samples.back().size); t < length;) {
      way = before + t;
      add(a + (t / length) * (b - a));
      t += std::max(least, kStep * samples.back().size);
    }
    way = before + length;
    add(b);
  }
  return samples;
}

void locateSamples(std::vector<std::vector<LineSample>>& lines, const std::vector<double>& elements,
                   const ShoreTriangles& t) {
  std::vector<Box> boxes;
  std::vector<std::pair<LineSample*, double>> samples;
  for (std::size_t line = 0; line < lines.size(); ++line) {
    for (LineSample& sample : lines[line]) {
      samples.emplace_back(&sample, elements[line]);
      boxes.push_back(Box::of(sample.at, sample.at));
    }
  }
  const BoxTree tree(boxes, BoxTree::Order::Hilbert);
  const BoxGrid grid(boxes);
  for (TriId i = 0; i < t.mesh.triangles.size(); ++i) {
    if (t.mesh.regions[i] == t.land) continue;
    const auto& v = t.mesh.triangles[i].v;
    const Point &a = t.mesh.point(v[0]), &b = t.mesh.point(v[1]), &c = t.mesh.point(v[2]);
    Box box = Box::of(a, b);
    box.add(c);
    if (!grid.mayMeet(box)) continue;
    tree.visit(box, [&](std::uint32_t s) {
      auto& [sample, wanted] = samples[s];
      if (!isIn(sample->at, a, b, c)) return;
      sample->water = t.mesh.regions[i];
      sample->wanting = t.width[i] < wanted;
    });
  }
  markBeyond(lines, t);
}

std::vector<LandOnLine> landsOn(const std::vector<LineSample>& samples) {
  std::vector<LandOnLine> lands;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    if (isWet(samples[i])) continue;
    std::size_t end = i;
    while (end < samples.size() && !isWet(samples[end])) ++end;
    const bool after_water = i > 0, before_water = end < samples.size();
    if (after_water || before_water) {
      // Shores lie between samples.
      const double from = after_water ? 0.5 * (samples[i - 1].way + samples[i].way) : samples[i].way;
      const double to = before_water ? 0.5 * (samples[end - 1].way + samples[end].way) : samples[end - 1].way;
      lands.push_back({i, end - 1, i + (end - i) / 2, to - from, !after_water || !before_water});
    }
    i = end;
  }
  return lands;
}

}  // namespace coastmesh
