#include "core/delaunay.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "core/delaunay_builder.hpp"
#include "core/hilbert.hpp"
#include "core/links.hpp"
#include "core/metric.hpp"

namespace coastmesh {

namespace {

[[noreturn]] void refuse(PslgDefect::Kind kind, const Point& place, SegmentId segment, std::string message,
                         SegmentId other = kNone) {
  throw BadPslg({kind, place, segment, other, std::move(message)});
}

void checkPlace(const Point& p, const std::string& what) {
  if (!std::isfinite(p.x) || !std::isfinite(p.y))
    refuse(PslgDefect::Kind::NotFinite, p, kNone, what + " is not a finite number");
  if (!isInRange(p)) refuse(PslgDefect::Kind::OutOfRange, p, kNone, what + " lies beyond -1e70 to 1e70");
}

void checkReferences(const Pslg& pslg) {
  for (const Point& p : pslg.points) checkPlace(p, "a coordinate");
  for (const Point& hole : pslg.holes) checkPlace(hole, "a coordinate of a hole");
  for (SegmentId s = 0; s < pslg.segments.size(); ++s) {
    const auto& [a, b, tag, left, right] = pslg.segments[s];
    if (a >= pslg.points.size() || b >= pslg.points.size())
      refuse(PslgDefect::Kind::UnknownVertex, {}, s, "a segment names a vertex that does not exist");
    if (a == b) refuse(PslgDefect::Kind::SegmentOfNoLength, pslg.points[a], s, "a segment has no length");
  }
}

Point crossingOf(const Pslg& pslg, SegmentId s, SegmentId other) {
  const Point &a = pslg.points[pslg.segments[s].a], &b = pslg.points[pslg.segments[s].b];
  const Point &c = pslg.points[pslg.segments[other].a], &d = pslg.points[pslg.segments[other].b];
  const double from = cross(d - c, a - c), to = cross(d - c, b - c);
  return a + (from / (from - to)) * (b - a);
}

void insertSegments(const Pslg& pslg, DelaunayBuilder& builder) {
  for (SegmentId s = 0; s < pslg.segments.size(); ++s) {
    const auto& [a, b, tag, left, right] = pslg.segments[s];
    try {
      builder.insertSegment(a, b, s);
    } catch (const DelaunayBuilder::Clash& clash) {
      switch (clash.kind) {
        case DelaunayBuilder::Clash::Kind::SegmentsCross:
          refuse(PslgDefect::Kind::SegmentsCross, crossingOf(pslg, s, clash.other), s, "two segments cross",
                 clash.other);
        case DelaunayBuilder::Clash::Kind::SegmentsCoincide:
          refuse(PslgDefect::Kind::SegmentsCoincide, midpoint(pslg.points[a], pslg.points[b]), s,
                 "two segments have the same ends", clash.other);
        default:
          refuse(PslgDefect::Kind::PointOnSegment, pslg.points[clash.at], s, "a vertex lies inside a segment");
      }
    }
  }
}

// Edges suffice, since a Delaunay triangulation joins nearest neighbours.
void checkDistances(const Pslg& pslg, const DelaunayBuilder& builder) {
  for (TriId t = 0; t < builder.triangles().size(); ++t) {
    if (builder.isGhost(t)) continue;
    const auto& v = builder.triangles()[t].v;
    for (unsigned i = 0; i < 3; ++i) {
      const Point &a = pslg.points[v[i]], &b = pslg.points[v[next3(i)]];
      if (std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)) >= kLeastDistance) continue;
      refuse(PslgDefect::Kind::OutOfRange, a, kNone, "two vertices are nearer to one another than 1e-70");
    }
  }
}

constexpr RegionId kUnvisited = kUnlabelled;

// Assigns a region to every triangle: floods from labels, holes and the outside, up to the segments.
class Carver {
 public:
  Carver(const Pslg& pslg, const DelaunayBuilder& builder)
      : pslg_(pslg), builder_(builder), triangles_(builder.triangles()), region_(triangles_.size(), kUnvisited) {}

  std::vector<RegionId> run() {
    const auto isLabelled = [](const Segment& s) { return s.left != kUnlabelled || s.right != kUnlabelled; };
    if (std::ranges::any_of(pslg_.segments, isLabelled)) {
      floodFromLabels();
    } else {
      if (!pslg_.segments.empty()) flood(firstGhost(), kOutside);
      TriId at = 0;
      for (const std::uint32_t hole : hilbertOrder(pslg_.holes)) {
        at = builder_.locate(pslg_.holes[hole], at);
        flood(at, kOutside);
      }
      std::ranges::replace(region_, kUnvisited, 0);
    }
    for (TriId t = 0; t < triangles_.size(); ++t)
      if (region_[t] == kUnvisited || builder_.isGhost(t)) region_[t] = kOutside;
    return std::move(region_);
  }

 private:
  TriId firstGhost() const {
    TriId t = 0;
    while (!builder_.isGhost(t)) ++t;
    return t;
  }

  void floodFromLabels() {
    for (TriId t = 0; t < triangles_.size(); ++t) {
      for (unsigned i = 0; i < 3; ++i) {
        if (triangles_[t].seg[i] == kNone) continue;
        const RegionId label = labelOn(t, i);
        if (label == kUnlabelled) continue;
        flood(t, label);
        if (region_[t] != label) refuseLabel(t, i);
      }
    }
  }

  // Reports that edge i labels triangle t differently from its region; searches for a segment that gave it that region.
  [[noreturn]] void refuseLabel(TriId t, unsigned i) {
    const SegmentId here = triangles_[t].seg[i];
    const RegionId given = region_[t];
    SegmentId other = kNone;
    std::vector<bool> seen(triangles_.size(), false);
    seen[t] = true;
    stack_.assign(1, t);
    while (!stack_.empty() && other == kNone) {
      const TriId at = stack_.back();
      stack_.pop_back();
      for (unsigned j = 0; j < 3; ++j) {
        const SegmentId s = triangles_[at].seg[j];
        const TriId next = triOf(triangles_[at].adj[j]);
        if (s != kNone && labelOn(at, j) == given) other = s;
        if (s != kNone || seen[next]) continue;
        seen[next] = true;
        stack_.push_back(next);
      }
    }
    const Segment& segment = pslg_.segments[here];
    refuse(PslgDefect::Kind::LabelsContradict, midpoint(pslg_.points[segment.a], pslg_.points[segment.b]), here,
           "two segments label the same place differently", other);
  }

  // The label that the segment on edge i gives to triangle t.
  RegionId labelOn(TriId t, unsigned i) const {
    const Segment& segment = pslg_.segments[triangles_[t].seg[i]];
    return triangles_[t].v[next3(i)] == segment.a ? segment.left : segment.right;
  }

  void flood(TriId start, RegionId label) {
    if (region_[start] != kUnvisited) return;
    region_[start] = label;
    stack_.push_back(start);
    while (!stack_.empty()) {
      const Triangle& here = triangles_[stack_.back()];
      stack_.pop_back();
      for (unsigned i = 0; i < 3; ++i) {
        const TriId other = triOf(here.adj[i]);
        if (here.seg[i] != kNone || region_[other] != kUnvisited) continue;
        region_[other] = label;
        stack_.push_back(other);
      }
    }
  }

  const Pslg& pslg_;
  const DelaunayBuilder& builder_;
  std::span<const Triangle> triangles_;
  std::vector<RegionId> region_;
  std::vector<TriId> stack_;
};

// The new numbers of the triangles that are kept, ordered by their last corner along Hilbert's curve; kNone for the
// others.
std::vector<TriId> numberAlongCurve(const DelaunayBuilder& builder, const std::vector<RegionId>& region, TriId& count) {
  const std::span<const Triangle> triangles = builder.triangles();
  std::vector<std::uint32_t> place(builder.alongCurve().size());
  for (std::uint32_t i = 0; const VertexId v : builder.alongCurve()) place[v] = i++;
  const auto last = [&](TriId t) {
    const auto& v = triangles[t].v;
    return std::max({place[v[0]], place[v[1]], place[v[2]]});
  };
  std::vector<TriId> first(place.size() + 1, 0);
  for (TriId t = 0; t < triangles.size(); ++t)
    if (region[t] != kOutside) ++first[last(t) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  count = first.back();
  std::vector<TriId> numbers(triangles.size(), kNone);
  for (TriId t = 0; t < triangles.size(); ++t)
    if (region[t] != kOutside) numbers[t] = first[last(t)]++;
  return numbers;
}

DelaunayBuilder triangulate(const Pslg& pslg, const Surface& surface) {
  try {
    return DelaunayBuilder(pslg.points, surface);
  } catch (const DelaunayBuilder::Clash& clash) {
    refuse(PslgDefect::Kind::PointsCoincide, pslg.points[clash.at], kNone, "two vertices lie at the same place");
  }
}

}  // namespace

TriMesh constrainedDelaunay(const Pslg& pslg, const Surface& surface) {
  checkReferences(pslg);
  DelaunayBuilder builder = triangulate(pslg, surface);
  if (!builder.hasTriangles())
    refuse(PslgDefect::Kind::NoArea, pslg.points.empty() ? Point{} : pslg.points.front(), kNone,
           "the vertices lie on one line and enclose no area");
  checkDistances(pslg, builder);
  insertSegments(pslg, builder);

  const std::vector<RegionId> region = Carver(pslg, builder).run();
  TriId count = 0;
  const std::vector<TriId> numbers = numberAlongCurve(builder, region, count);
  if (count == 0) refuse(PslgDefect::Kind::NoArea, pslg.points.front(), kNone, "the segments enclose no area");

  TriMesh mesh;
  mesh.points.assign(pslg.points.begin(), pslg.points.end());
  mesh.input_vertices = static_cast<VertexId>(pslg.points.size());
  mesh.triangles.resize(count);
  mesh.regions.resize(count);
  for (TriId from = 0; from < numbers.size(); ++from) {
    if (numbers[from] == kNone) continue;
    mesh.triangles[numbers[from]] = renumbered(
        builder.triangles()[from], [&](TriId t) { return numbers[t]; }, std::identity());
    mesh.regions[numbers[from]] = region[from];
  }
  assert(findBrokenLink(mesh.triangles) == kNone);
  return mesh;
}

}  // namespace coastmesh
