#include "core/refine/split_segments.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/edit_mesh.hpp"
#include "core/metric.hpp"

namespace coastmesh {

namespace {

// A subsegment to be divided.
struct Cut {
  VertexId a = kNone;
  VertexId b = kNone;
  SegmentId seg = kNone;
};

// Integration steps for each requested length: enough if it changes by a third from one edge to the next.
constexpr double kStepsALength = 4.0;
// Relative tolerance: pieces this much longer are accepted.
constexpr double kSameLength = 1e-9;

enum class Fit { Nearest, AtMost };

// Shares of the way from a to b that are one requested length apart, stretched to fit: to the nearest number of pieces,
// or so that none is longer. Stops early if there are clearly more than `most`.
void evenShares(const Point& a, const Point& b, const SizeFunction& size, Fit fit, const Surface& surface,
                std::uint64_t most, std::vector<double>& shares) {
  const auto wantedAt = [&](const Point& x) { return size.at(x) / surface.shrinkAt(x); };  // in the plane
  shares.clear();
  const double length = distance(a, b);
  // The number of requested lengths up to each step, by the trapezoid rule; steps follow the requested length.
  std::vector<std::pair<double, double>> marks{{0.0, 0.0}};
  double along = 0.0, count = 0.0, here = wantedAt(a);
  const double most_steps = 2.0 * kStepsALength * (static_cast<double>(most) + 1.0);
  while (along < length && static_cast<double>(marks.size()) < most_steps) {
    const double step = std::min(here / kStepsALength, length - along);
    const double next = step >= length - along ? length : along + step;
    if (!(next > along)) break;  // lengths below what coordinates resolve
    const double there = wantedAt(a + (next / length) * (b - a));
    count += 0.5 * (next - along) * (1.0 / here + 1.0 / there);
    along = next;
    here = there;
    marks.push_back({along, count});
  }
  double pieces = std::max(1.0, std::floor(count));
  // Nearest: the number of pieces that makes their ratio to the requested length closest to 1, either way.
  const double one_more_from = fit == Fit::Nearest ? std::sqrt(pieces * (pieces + 1.0)) : pieces * (1.0 + kSameLength);
  if (count > one_more_from) pieces += 1.0;
  std::size_t i = 0;
  for (double k = 1.0; k < pieces; k += 1.0) {
    const double target = count * k / pieces;
    while (i + 2 < marks.size() && marks[i + 1].second < target) ++i;
    const auto [from, before] = marks[i];
    const auto [to, after] = marks[i + 1];
    shares.push_back((from + (to - from) * (target - before) / (after - before)) / length);
  }
}

EdgeRef findEdge(const EditMesh& mesh, const std::vector<TriId>& among, VertexId a, VertexId b) {
  for (const TriId t : among) {
    if (!mesh.isLive(t)) continue;
    for (unsigned i = 0; i < 3; ++i) {
      const VertexId from = mesh.origin(edgeRef(t, i)), to = mesh.target(edgeRef(t, i));
      if ((from == a && to == b) || (from == b && to == a)) return edgeRef(t, i);
    }
  }
  return kNone;
}

}  // namespace

bool wantsSplitSegments(const TriMesh& mesh, const RefineOptions& options) {
  const bool has_lattice = mesh.points.size() > mesh.input_vertices;
  return options.size != nullptr || (has_lattice && std::isfinite(options.size_max));
}

std::uint64_t splitSegments(TriMesh& mesh, const Pslg& pslg, VertexNotes& notes, const RefineOptions& options) {
  const ConstantSize longest(options.size_max);
  const SizeFunction& size = options.size != nullptr ? *options.size : longest;
  const Fit fit = options.size != nullptr ? Fit::Nearest : Fit::AtMost;
  std::vector<Cut> cuts;
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      if (mesh.segment(e) >= pslg.segments.size()) continue;
      if (mesh.twin(e) != kNone && mesh.twin(e) < e) continue;
      cuts.push_back({mesh.origin(e), mesh.target(e), mesh.segment(e)});
    }
  }
  const VertexId before = static_cast<VertexId>(mesh.points.size());
  const std::uint64_t most = std::min<std::uint64_t>(options.max_vertices, kNone);
  EditMesh edit(std::move(mesh));
  std::vector<double> shares;
  std::vector<TriId> touched, star;
  std::vector<EdgeRef> opposite;
  for (const Cut& cut : cuts) {
    if (edit.vertexCount() >= most) break;
    const Point a = edit.point(cut.a), b = edit.point(cut.b);
    evenShares(a, b, size, fit, options.surface, most - edit.vertexCount(), shares);
    VertexId from = cut.a;
    for (const double share : shares) {
      if (edit.vertexCount() >= most) break;
      edit.star(from, opposite);
      star.clear();
      for (const EdgeRef e : opposite) star.push_back(triOf(e));
      const EdgeRef edge = findEdge(edit, star, from, cut.b);
      if (edge == kNone) break;
      const Segment& seg = pslg.segments[cut.seg];
      const Point &sa = pslg.points[seg.a], &sb = pslg.points[seg.b];
      const Point on = projectedOnLine(a + share * (b - a), sa, sb);
      touched.clear();
      const VertexId v = edit.splitSegment(edge, on, touched);
      if (v == kNone) break;
      notes.spacing.resize(edit.vertexSlots());
      notes.spacing[v] = std::min({options.surface.chord(on, a) + notes.spacing[cut.a],
                                   options.surface.chord(on, b) + notes.spacing[cut.b], size.at(on)});
      from = v;
    }
  }
  Renumbering by;
  mesh = edit.release(by, false);
  std::vector<double> spacing(mesh.points.size());
  for (VertexId v = 0; v < by.vertex.size(); ++v)
    if (by.vertex[v] != kNone) spacing[by.vertex[v]] = notes.spacing[v];
  notes.spacing = std::move(spacing);
  return mesh.points.size() - before;
}

}  // namespace coastmesh
