#include "core/refine/divide_segments.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <utility>

#include "core/metric.hpp"

namespace coastmesh {

namespace {

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

}  // namespace

Divided SegmentDivider::divide(const Point& a, const Point& b, SegmentId seg, std::uint64_t most) const {
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

std::vector<Subsegment> subsegmentsOf(const TriMesh& mesh, const Pslg& pslg, const ItemLoop& loop) {
  return joined(overStretches(loop, mesh.triangles.size(), [&](std::size_t first, std::size_t last) {
    std::vector<Subsegment> all;
    for (auto t = static_cast<TriId>(first); t < last; ++t) {
      for (unsigned i = 0; i < 3; ++i) {
        const EdgeRef e = edgeRef(t, i);
        if (!mayDivide(pslg, mesh.segment(e))) continue;
        if (mesh.twin(e) != kNone && mesh.twin(e) < e) continue;
        all.push_back({mesh.origin(e), mesh.target(e), mesh.segment(e), e});
      }
    }
    return all;
  }));
}

namespace {

// Each subsegment's divisions; empty if they are more than `room`.
std::vector<Divided> divideAll(const TriMesh& mesh, const std::vector<Subsegment>& all, const SegmentDivider& divider,
                               std::uint64_t room, const ItemLoop& loop) {
  std::vector<Divided> divided(all.size());
  const auto divide = [&](std::size_t i, std::uint64_t most) {
    divided[i] = divider.divide(mesh.point(all[i].a), mesh.point(all[i].b), all[i].seg, most);
  };
  const auto divideFew = [&](std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) divide(i, kManyDivisions);
  };
  forStretches(loop, all.size(), divideFew, kSubsegmentsAtOnce);
  std::uint64_t points = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!divided[i].is_whole) divide(i, room - points);
    points += divided[i].divisions.size();
    if (!divided[i].is_whole || points > room) return {};
  }
  return divided;
}

// True if rounding cannot make pieces of a segment touch what is around it: all divisions lie inside the two triangles
// beside it, clearly away from their other sides.
class Clearance {
 public:
  Clearance(const TriMesh& mesh, const ItemLoop& loop) : mesh_(mesh) {
    constexpr double kRoundings = 64.0;
    const auto largest = overStretches(loop, mesh.points.size(), [&](std::size_t first, std::size_t last) {
      double most = 0.0;
      for (std::size_t v = first; v < last; ++v)
        most = std::max({most, std::abs(mesh.points[v].x), std::abs(mesh.points[v].y)});
      return most;
    });
    least_ = kRoundings * std::numeric_limits<double>::epsilon() * std::ranges::max(largest);
  }

  bool holds(EdgeRef edge, const std::vector<Division>& divisions) const {
    const auto isClear = [&](EdgeRef side) {
      return std::ranges::all_of(divisions, [&](const Division& d) { return distanceFrom(side, d.at) > least_; });
    };
    for (const EdgeRef e : {edge, mesh_.twin(edge)})
      if (e != kNone &&
          !(isClear(edgeRef(triOf(e), next3(indexOf(e)))) && isClear(edgeRef(triOf(e), prev3(indexOf(e))))))
        return false;
    return true;
  }

 private:
  // Positive to the left.
  double distanceFrom(EdgeRef e, const Point& x) const {
    const Point &a = mesh_.point(mesh_.origin(e)), &b = mesh_.point(mesh_.target(e));
    return cross(b - a, x - a) / distance(a, b);
  }

  const TriMesh& mesh_;
  double least_ = 0.0;
};

// Divides the segments, of which `number[s]` is the subsegment, kNone if there is none.
void addPieces(const Pslg& pslg, const std::vector<Subsegment>& all, const std::vector<VertexId>& starts,
               const std::vector<std::uint32_t>& number, const ItemLoop& loop, DividedSegments& made) {
  const auto pointsOf = [&](SegmentId s) { return number[s] == kNone ? 0 : starts[number[s] + 1] - starts[number[s]]; };
  std::vector<std::size_t> first{0};
  first.reserve(pslg.segments.size() + 1);
  for (SegmentId s = 0; s < pslg.segments.size(); ++s) first.push_back(first.back() + 1 + pointsOf(s));
  made.pieces.resize(first.back());
  made.of.resize(first.back());
  const auto input = static_cast<VertexId>(pslg.points.size());
  forEachByStretches(loop, pslg.segments.size(), [&](std::size_t i) {
    const auto s = static_cast<SegmentId>(i);
    const VertexId points = pointsOf(s);
    const bool forward = points == 0 || all[number[s]].a == pslg.segments[s].a;
    VertexId from = pslg.segments[s].a;
    for (VertexId k = 0; k <= points; ++k) {
      const VertexId to = k == points ? pslg.segments[s].b : input + starts[number[s]] + (forward ? k : points - 1 - k);
      made.pieces[first[s] + k] = pslg.segments[s];
      made.pieces[first[s] + k].a = from;
      made.pieces[first[s] + k].b = to;
      made.of[first[s] + k] = s;
      from = to;
    }
  });
}

}  // namespace

DividedSegments divideSegments(const TriMesh& mesh, const Pslg& pslg, const VertexNotes& notes,
                               const RefineOptions& options, std::uint64_t room, const ItemLoop& loop) {
  const std::vector<Subsegment> all = subsegmentsOf(mesh, pslg, loop);
  const std::vector<Divided> divided =
      divideAll(mesh, all, SegmentDivider(pslg, options), std::min<std::uint64_t>(room, kNone), loop);
  std::vector<VertexId> starts{0};
  for (const Divided& d : divided) starts.push_back(starts.back() + static_cast<VertexId>(d.divisions.size()));
  if (starts.back() == 0) return {};
  const Clearance clearance(mesh, loop);
  std::vector<std::uint32_t> number(pslg.segments.size(), kNone);
  DividedSegments made;
  resizeUnset(made.points, starts.back());
  resizeUnset(made.spacing, starts.back());
  const auto add = [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      const auto& [a, b, seg, edge] = all[i];
      if (!clearance.holds(edge, divided[i].divisions)) return std::uint8_t{0};
      number[seg] = static_cast<std::uint32_t>(i);
      for (std::size_t k = 0; k < divided[i].divisions.size(); ++k) {
        const auto& [at, size] = divided[i].divisions[k];
        made.points[starts[i] + k] = at;
        made.spacing[starts[i] + k] = std::min({options.surface.chord(at, mesh.point(a)) + notes.spacing[a],
                                                options.surface.chord(at, mesh.point(b)) + notes.spacing[b], size});
      }
    }
    return std::uint8_t{1};
  };
  if (!std::ranges::all_of(overStretches(loop, all.size(), add, kSubsegmentsAtOnce), std::identity())) return {};
  addPieces(pslg, all, starts, number, loop, made);
  return made;
}

}  // namespace coastmesh
