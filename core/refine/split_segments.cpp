#include "core/refine/split_segments.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/edit_mesh.hpp"
#include "core/metric.hpp"
#include "core/size_function.hpp"

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
// or so that none is longer. Stops early, and returns false, if there are clearly more than `most`.
bool evenShares(const Point& a, const Point& b, const SizeFunction& size, Fit fit, const Surface& surface,
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
  const bool is_whole = static_cast<double>(marks.size()) < most_steps;
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
  return is_whole;
}

// A point that divides a subsegment, and the length requested there.
struct Division {
  Point at;
  double size;
};

struct Divided {
  std::vector<Division> divisions;
  bool is_whole = true;  // false if it ends early, as `evenShares` does
};

// Divides subsegments by the requested lengths.
class Divider {
 public:
  Divider(const Pslg& pslg, const RefineOptions& options)
      : pslg_(pslg), options_(options), longest_(options.size_max) {}

  // Divides part of a segment, from a to b.
  Divided divide(const Point& a, const Point& b, SegmentId seg, std::uint64_t most) const {
    const SizeFunction& size = options_.size != nullptr ? *options_.size : longest_;
    const Fit fit = options_.size != nullptr ? Fit::Nearest : Fit::AtMost;
    const Segment& segment = pslg_.segments[seg];
    std::vector<double> shares;
    Divided divided;
    divided.is_whole = evenShares(a, b, size, fit, options_.surface, most, shares);
    divided.divisions.reserve(shares.size());
    for (const double share : shares) {
      const Point at = projectedOnLine(a + share * (b - a), pslg_.points[segment.a], pslg_.points[segment.b]);
      divided.divisions.push_back({at, size.at(at)});
    }
    return divided;
  }

 private:
  const Pslg& pslg_;
  const RefineOptions& options_;
  const ConstantSize longest_;
};

// An edge from a to b or back, kNone if there is none: of its two sides the first around a, counter-clockwise from
// `triangleOf(a)`, or from the boundary. Other triangles around a are not visited if that can be avoided.
EdgeRef findEdge(const EditMesh& mesh, VertexId a, VertexId b, std::vector<EdgeRef>& star) {
  const TriId home = mesh.triangleOf(a);
  for (TriId t = home;;) {
    const unsigned i = mesh.cornerOf(t, a);
    const auto& v = mesh.triangle(t).v;
    if (v[prev3(i)] == b) return edgeRef(t, next3(i));
    const EdgeRef before = edgeRef(t, prev3(i)), after = edgeRef(t, next3(i));
    if (v[next3(i)] == b && mesh.twin(before) == kNone) return before;
    if (v[next3(i)] == b || mesh.twin(after) == kNone) break;
    t = triOf(mesh.twin(after));
    if (t == home) return kNone;
  }
  mesh.star(a, star);
  for (const EdgeRef opposite : star) {
    if (mesh.origin(opposite) == b) return edgeRef(triOf(opposite), prev3(indexOf(opposite)));
    if (mesh.target(opposite) == b) return edgeRef(triOf(opposite), next3(indexOf(opposite)));
  }
  return kNone;
}

// The subsegments of a mesh, by triangle.
std::vector<Cut> subsegmentsOf(const TriMesh& mesh, const Pslg& pslg, const ItemLoop& loop) {
  return joined(overStretches(loop, mesh.triangles.size(), [&](std::size_t first, std::size_t last) {
    std::vector<Cut> cuts;
    for (auto t = static_cast<TriId>(first); t < last; ++t) {
      for (unsigned i = 0; i < 3; ++i) {
        const EdgeRef e = edgeRef(t, i);
        if (!mayDivide(pslg, mesh.segment(e))) continue;
        if (mesh.twin(e) != kNone && mesh.twin(e) < e) continue;
        cuts.push_back({mesh.origin(e), mesh.target(e), mesh.segment(e)});
      }
    }
    return cuts;
  }));
}

}  // namespace

bool wantsSplitSegments(const TriMesh& mesh, const RefineOptions& options) {
  const bool has_lattice = mesh.points.size() > mesh.input_vertices;
  return options.size != nullptr || (has_lattice && std::isfinite(options.size_max));
}

std::uint64_t splitSegments(TriMesh& mesh, const Pslg& pslg, VertexNotes& notes, const RefineOptions& options,
                            const ItemLoop& loop) {
  const std::vector<Cut> cuts = subsegmentsOf(mesh, pslg, loop);
  const VertexId before = static_cast<VertexId>(mesh.points.size());
  const std::uint64_t most = std::min<std::uint64_t>(options.max_vertices, kNone);
  constexpr std::size_t kWorthThreads = 1 << 15;
  EditMesh edit = before < kWorthThreads ? EditMesh(std::move(mesh)) : EditMesh(std::move(mesh), loop);
  const Divider divider(pslg, options);
  std::vector<TriId> touched;
  std::vector<EdgeRef> star;
  const auto apply = [&](const Cut& cut, const std::vector<Division>& divisions) {
    const Point a = edit.point(cut.a), b = edit.point(cut.b);
    VertexId from = cut.a;
    for (const auto& [on, size] : divisions) {
      if (edit.vertexCount() >= most) break;
      const EdgeRef edge = findEdge(edit, from, cut.b, star);
      if (edge == kNone) break;
      touched.clear();
      const VertexId v = edit.splitSegment(edge, on, touched);
      if (v == kNone) break;
      notes.spacing.resize(edit.vertexSlots());
      notes.spacing[v] = std::min({options.surface.chord(on, a) + notes.spacing[cut.a],
                                   options.surface.chord(on, b) + notes.spacing[cut.b], size});
      from = v;
    }
  };
  // Divided in batches, the few subsegments with very many divisions one by one: otherwise all would be divided when
  // there is no more room.
  constexpr std::size_t kBatch = 4096, kStretch = 64;
  constexpr std::uint64_t kMany = 250;
  std::vector<Divided> batch(std::min(cuts.size(), kBatch));
  const auto divide = [&](const Cut& cut, std::uint64_t at_most) {
    return divider.divide(edit.point(cut.a), edit.point(cut.b), cut.seg, at_most);
  };
  for (std::size_t begin = 0; begin < cuts.size() && edit.vertexCount() < most; begin += kBatch) {
    const std::size_t count = std::min(kBatch, cuts.size() - begin);
    forStretches(
        loop, count,
        [&](std::size_t first, std::size_t last) {
          for (std::size_t i = first; i < last; ++i) batch[i] = divide(cuts[begin + i], kMany);
        },
        kStretch);
    for (std::size_t i = 0; i < count && edit.vertexCount() < most; ++i) {
      if (!batch[i].is_whole) batch[i] = divide(cuts[begin + i], most - edit.vertexCount());
      apply(cuts[begin + i], batch[i].divisions);
    }
  }
  Renumbering by;
  mesh = edit.vertexCount() < kWorthThreads ? edit.release(by, false) : edit.releaseOn(loop, by);
  BulkList<double> spacing = unsetList<double>(mesh.points.size());  // every vertex comes from one before
  forEachByStretches(loop, by.vertex.size(), [&](std::size_t v) {
    if (by.vertex[v] != kNone) spacing[by.vertex[v]] = notes.spacing[v];
  });
  notes.spacing = std::move(spacing);
  return mesh.points.size() - before;
}

}  // namespace coastmesh
