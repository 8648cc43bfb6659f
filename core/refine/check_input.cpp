#include "core/refine/check_input.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <compare>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <span>
#include <unordered_map>

#include "core/large_list.hpp"
#include "core/links.hpp"
#include "core/metric.hpp"
#include "core/point_hash.hpp"
#include "core/quality.hpp"
#include "core/sphere/close_sphere.hpp"
#include "core/triangulate/delaunay.hpp"

namespace coastmesh {

namespace {

PslgCover coverFromLabels(const Pslg& pslg) {
  PslgCover expected{std::vector<bool>(pslg.points.size(), false), std::vector<bool>(pslg.segments.size(), false)};
  // Relative to a point of the input, so that large coordinates do not swamp the area.
  const Point o = pslg.points.front();
  for (SegmentId s = 0; s < pslg.segments.size(); ++s) {
    const Segment& seg = pslg.segments[s];
    // A segment without labels is an open line inside the domain.
    const bool inside = seg.left >= 0 || seg.right >= 0 || (seg.left == kUnlabelled && seg.right == kUnlabelled);
    if (!inside) continue;
    expected.segments[s] = expected.vertices[seg.a] = expected.vertices[seg.b] = true;
    const double swept = 0.5 * cross(pslg.points[seg.a] - o, pslg.points[seg.b] - pslg.points[seg.a]);
    if (seg.left >= 0) expected.area += swept;
    if (seg.right >= 0) expected.area -= swept;
  }
  return expected;
}

double totalArea(const TriMesh& mesh, const ItemLoop& loop) {
  const std::vector<double> areas =
      overStretches(loop, mesh.triangles.size(), [&](std::size_t first, std::size_t last) {
        double area = 0.0;
        for (const Triangle& t : std::span(mesh.triangles).subspan(first, last - first))
          area += signedArea(mesh.points[t.v[0]], mesh.points[t.v[1]], mesh.points[t.v[2]]);
        return area;
      });
  return std::accumulate(areas.begin(), areas.end(), 0.0);
}

// The cover of a mesh without a boundary, a whole sphere: all of the input. The plane has no area for it.
PslgCover coverOfAll(const Pslg& pslg) {
  return {std::vector<bool>(pslg.points.size(), true), std::vector<bool>(pslg.segments.size(), true)};
}

PslgCover expectedCover(const TriMesh& mesh, const Pslg& pslg) {
  if (isClosed(mesh)) return coverOfAll(pslg);
  return labelsTellAll(pslg) ? coverFromLabels(pslg) : coverOf(constrainedDelaunay(pslg), pslg);
}

// The possible error of the area from boundary points, which are rounded to the last place of a coordinate.
double roundingOfBoundary(const TriMesh& mesh, const ItemLoop& loop) {
  constexpr double kPlaces = 4.0;
  struct BoundaryExtent {
    double magnitude = 0.0;
    double length = 0.0;
  };
  BoundaryExtent whole;
  for (const BoundaryExtent& part :
       overStretches(loop, mesh.triangles.size(), [&](std::size_t first, std::size_t last) {
         BoundaryExtent boundary;
         for (const Triangle& t : std::span(mesh.triangles).subspan(first, last - first)) {
           for (unsigned i = 0; i < 3; ++i) {
             if (t.adj[i] != kNone) continue;
             const Point &a = mesh.points[t.v[next3(i)]], &b = mesh.points[t.v[prev3(i)]];
             boundary.magnitude = std::max({boundary.magnitude, std::abs(a.x), std::abs(a.y)});
             boundary.length += distance(a, b);
           }
         }
         return boundary;
       })) {
    whole.magnitude = std::max(whole.magnitude, part.magnitude);
    whole.length += part.length;
  }
  return kPlaces * std::numeric_limits<double>::epsilon() * whole.magnitude * whole.length;
}

void checkArea(const TriMesh& mesh, double expected, double tolerance, const ItemLoop& loop,
               std::vector<MeshDefect>& defects) {
  const double difference = std::abs(totalArea(mesh, loop) - expected);
  if (difference <= tolerance * expected + roundingOfBoundary(mesh, loop)) return;
  const double error = difference / expected;
  defects.push_back({DefectKind::WrongArea, mesh.points.empty() ? Point{} : mesh.points.front(), kNone, error});
}

// The edges that carry a segment's number, each as two half-edges.
struct HalfEdge {
  VertexId from;
  VertexId to;

  friend auto operator<=>(const HalfEdge&, const HalfEdge&) = default;
};

// The half-edges of all segments, grouped by segment.
struct SegmentEdges {
  std::vector<HalfEdge> halves;
  std::vector<std::uint32_t> starts;  // one for each segment, and the end of the last

  std::span<HalfEdge> of(SegmentId s) {
    return std::span(halves).subspan(starts[s], starts[std::size_t{s} + 1] - starts[s]);
  }
};

// Reports edges with a number that no segment has.
SegmentEdges edgesBySegment(const TriMesh& mesh, const Pslg& pslg, const ItemLoop& loop,
                            std::vector<MeshDefect>& defects) {
  const std::vector<EdgeRef> constrained =
      joined(overStretches(loop, mesh.triangles.size(), [&](std::size_t first, std::size_t last) {
        std::vector<EdgeRef> edges;
        for (auto t = static_cast<TriId>(first); t < last; ++t)
          for (unsigned i = 0; i < 3; ++i)
            if (const EdgeRef e = edgeRef(t, i);
                mesh.segment(e) != kNone && (mesh.twin(e) == kNone || mesh.twin(e) > e))
              edges.push_back(e);
        return edges;
      }));
  SegmentEdges edges;
  edges.starts.assign(pslg.segments.size() + 1, 0);
  const auto count = [&](std::size_t i, std::vector<MeshDefect>& unknown) {
    const EdgeRef e = constrained[i];
    if (const SegmentId s = mesh.segment(e); s < pslg.segments.size()) {
      __atomic_add_fetch(&edges.starts[std::size_t{s} + 1], 2, __ATOMIC_RELAXED);
    } else {
      unknown.push_back({DefectKind::BrokenTopology, mesh.points[mesh.origin(e)], triOf(e)});
    }
  };
  std::ranges::move(listOver<MeshDefect>(loop, constrained.size(), count), std::back_inserter(defects));
  std::partial_sum(edges.starts.begin(), edges.starts.end(), edges.starts.begin());
  edges.halves.resize(edges.starts.back());
  // In any order, on which `isChain` does not depend.
  std::vector<std::uint32_t> next(edges.starts.begin(), edges.starts.end() - 1);
  forEachByStretches(loop, constrained.size(), [&](std::size_t i) {
    const EdgeRef e = constrained[i];
    const SegmentId s = mesh.segment(e);
    if (s >= pslg.segments.size()) return;
    const std::uint32_t at = __atomic_fetch_add(&next[s], 2, __ATOMIC_RELAXED);
    edges.halves[at] = {mesh.origin(e), mesh.target(e)};
    edges.halves[at + 1] = {mesh.target(e), mesh.origin(e)};
  });
  return edges;
}

// True if the edges form one chain between the segment's ends that, up to rounding, neither leaves it nor turns back.
bool isChain(const TriMesh& mesh, const Pslg& pslg, const Segment& seg, std::span<HalfEdge> halves) {
  if (halves.size() == 2) {
    const auto [from, to] = halves.front();
    return (from == seg.a && to == seg.b) || (from == seg.b && to == seg.a);
  }
  std::ranges::sort(halves);
  const Point &a = pslg.points[seg.a], &b = pslg.points[seg.b];
  const double magnitude = std::max({std::abs(a.x), std::abs(a.y), std::abs(b.x), std::abs(b.y)});
  const double room = 8.0 * std::numeric_limits<double>::epsilon() * magnitude * distance(a, b);
  // Every step uses another edge, until none is left.
  VertexId before = kNone, at = seg.a;
  for (std::size_t left = halves.size() / 2; left > 0; --left) {
    auto [out, end] = std::ranges::equal_range(halves, at, {}, &HalfEdge::from);
    if (end - out != (left == halves.size() / 2 ? 1 : 2)) return false;
    if (out->to == before) ++out;
    const Point step = mesh.points[out->to] - mesh.points[at];
    if (dot(b - a, step) < -room || std::abs(cross(b - a, mesh.points[out->to] - a)) > room) return false;
    before = at;
    at = out->to;
  }
  return at == seg.b;
}

bool areSameBits(const Point& p, const Point& q) {
  return std::bit_cast<std::uint64_t>(p.x) == std::bit_cast<std::uint64_t>(q.x) &&
         std::bit_cast<std::uint64_t>(p.y) == std::bit_cast<std::uint64_t>(q.y);
}

// Appends a defect for each number below `count` for which `isMissing` is true, at its place.
template <typename IsMissing, typename PlaceOf>
void reportMissing(DefectKind kind, std::size_t count, const ItemLoop& loop, const IsMissing& isMissing,
                   const PlaceOf& placeOf, std::vector<MeshDefect>& defects) {
  const std::vector<MeshDefect> found = joined(overStretches(loop, count, [&](std::size_t first, std::size_t last) {
    std::vector<MeshDefect> here;
    for (auto i = static_cast<std::uint32_t>(first); i < last; ++i)
      if (isMissing(i)) here.push_back({kind, placeOf(i)});
    return here;
  }));
  defects.insert(defects.end(), found.begin(), found.end());
}

}  // namespace

bool labelsTellAll(const Pslg& pslg) {
  bool labelled = false;
  std::vector<bool> on_segment(pslg.points.size(), false);
  for (const Segment& s : pslg.segments) {
    labelled |= s.left != kUnlabelled || s.right != kUnlabelled;
    on_segment[s.a] = on_segment[s.b] = true;
  }
  return labelled && std::ranges::find(on_segment, false) == on_segment.end();
}

PslgCover coverOf(const TriMesh& coarse, const Pslg& pslg) {
  PslgCover cover{std::vector<bool>(pslg.points.size(), false), std::vector<bool>(pslg.segments.size(), false)};
  for (const Triangle& t : coarse.triangles) {
    for (unsigned i = 0; i < 3; ++i) {
      cover.vertices[t.v[i]] = true;
      if (t.seg[i] != kNone) cover.segments[t.seg[i]] = true;
    }
  }
  cover.area = totalArea(coarse, inOrder);
  return cover;
}

void checkAgainstInput(const TriMesh& mesh, std::span<const std::uint8_t> used, const Pslg& pslg,
                       const PslgCover* known, const ItemLoop& loop, std::vector<MeshDefect>& defects) {
  const PslgCover computed = known != nullptr ? PslgCover() : expectedCover(mesh, pslg);
  const PslgCover& expected = known != nullptr ? *known : computed;
  SegmentEdges edges = edgesBySegment(mesh, pslg, loop, defects);
  reportMissing(
      DefectKind::MissingVertex, pslg.points.size(), loop,
      [&](VertexId v) {
        return expected.vertices[v] &&
               !(v < mesh.points.size() && areSameBits(mesh.points[v], pslg.points[v]) && used[v]);
      },
      [&](VertexId v) { return pslg.points[v]; }, defects);
  reportMissing(
      DefectKind::MissingSegment, pslg.segments.size(), loop,
      [&](SegmentId s) { return expected.segments[s] && !isChain(mesh, pslg, pslg.segments[s], edges.of(s)); },
      [&](SegmentId s) { return midpoint(pslg.points[pslg.segments[s].a], pslg.points[pslg.segments[s].b]); }, defects);
  if (!isClosed(mesh)) checkArea(mesh, expected.area, 1e-9, loop, defects);
}

namespace {

// Marks the edges on the straight line from one vertex to another. Returns false if they leave it.
bool markChain(TriMesh& mesh, const std::vector<std::vector<EdgeRef>>& around, VertexId from, VertexId to,
               SegmentId seg) {
  constexpr double kDirectionRounding = 1e-6;
  VertexId at = from;
  // Every step gets closer to the end, so no vertex is visited twice.
  while (at != to) {
    const Point way = mesh.points[to] - mesh.points[at];
    const double left = std::sqrt(squaredLength(way));
    EdgeRef best = kNone;
    double best_sine = kDirectionRounding;
    for (const EdgeRef e : around[at]) {
      const VertexId other = mesh.origin(e) == at ? mesh.target(e) : mesh.origin(e);
      const Point step = mesh.points[other] - mesh.points[at];
      const double length = std::sqrt(squaredLength(step));
      if (dot(step, way) <= 0.0 || (other != to && length >= left)) continue;
      const double sine = other == to ? 0.0 : std::abs(cross(step, way)) / (length * left);
      if (sine > best_sine || (best != kNone && sine == best_sine)) continue;
      best_sine = sine;
      best = e;
    }
    if (best == kNone) return false;
    setSegment(mesh.triangles, best, seg);
    at = mesh.origin(best) == at ? mesh.target(best) : mesh.origin(best);
  }
  return true;
}

}  // namespace

void checkAgainstInputByPlace(TriMesh& mesh, const Pslg& pslg, std::vector<MeshDefect>& defects) {
  const PslgCover expected = expectedCover(mesh, pslg);
  std::unordered_map<Point, VertexId, PointHash> at;
  at.reserve(pslg.points.size());
  for (const Point& x : pslg.points) at.emplace(x, kNone);
  for (VertexId v = 0; v < mesh.points.size(); ++v)
    if (const auto found = at.find(mesh.points[v]); found != at.end() && found->second == kNone) found->second = v;
  std::vector<VertexId> vertex(pslg.points.size(), kNone);
  for (VertexId v = 0; v < pslg.points.size(); ++v) {
    if (!expected.vertices[v]) continue;
    vertex[v] = at.find(pslg.points[v])->second;
    if (vertex[v] == kNone) {
      defects.push_back({DefectKind::MissingVertex, pslg.points[v]});
    }
  }
  std::vector<std::vector<EdgeRef>> around(mesh.points.size());
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      if (mesh.twin(e) != kNone && mesh.twin(e) < e) continue;
      around[mesh.origin(e)].push_back(e);
      around[mesh.target(e)].push_back(e);
    }
  }
  for (SegmentId s = 0; s < pslg.segments.size(); ++s) {
    if (!expected.segments[s]) continue;
    const VertexId a = vertex[pslg.segments[s].a], b = vertex[pslg.segments[s].b];
    if (a == kNone || b == kNone || !markChain(mesh, around, a, b, s))
      defects.push_back(
          {DefectKind::MissingSegment, midpoint(pslg.points[pslg.segments[s].a], pslg.points[pslg.segments[s].b])});
  }
  if (!isClosed(mesh)) checkArea(mesh, expected.area, 1e-6, inOrder, defects);
}

}  // namespace coastmesh
