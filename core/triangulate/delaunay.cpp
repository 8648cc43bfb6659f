#include "core/triangulate/delaunay.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "core/bulk_list.hpp"
#include "core/distribute.hpp"
#include "core/large_list.hpp"
#include "core/links.hpp"
#include "core/metric.hpp"
#include "core/triangulate/carve.hpp"
#include "core/triangulate/segment_inserter.hpp"
#include "core/triangulate/triangulate_points.hpp"

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

void checkReferences(const Pslg& pslg, const ItemLoop& loop) {
  forEachByStretches(loop, pslg.points.size(), [&](std::size_t i) { checkPlace(pslg.points[i], "a coordinate"); });
  for (const Point& hole : pslg.holes) checkPlace(hole, "a coordinate of a hole");
  for (SegmentId s = 0; s < pslg.segments.size(); ++s) {
    const VertexId a = pslg.segments[s].a, b = pslg.segments[s].b;
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

[[noreturn]] void refuse(const Clash& clash, const Pslg& pslg, SegmentId s) {
  const Point &a = pslg.points[pslg.segments[s].a], &b = pslg.points[pslg.segments[s].b];
  // Of two segments the later one is refused, whichever was inserted first.
  const SegmentId later = std::max(s, clash.other), earlier = std::min(s, clash.other);
  switch (clash.kind) {
    case Clash::Kind::SegmentsCross:
      refuse(PslgDefect::Kind::SegmentsCross, crossingOf(pslg, later, earlier), later, "two segments cross", earlier);
    case Clash::Kind::SegmentsCoincide:
      refuse(PslgDefect::Kind::SegmentsCoincide, midpoint(a, b), later, "two segments have the same ends", earlier);
    default:
      refuse(PslgDefect::Kind::PointOnSegment, pslg.points[clash.at], s, "a vertex lies inside a segment");
  }
}

// Most segments are edges already: these are found first, on all threads.
void insertSegments(const Pslg& pslg, Triangulation& triangulation, const ItemLoop& loop) {
  SegmentInserter inserter(triangulation);
  std::vector<EdgeRef> edges(pslg.segments.size());
  forEachByStretches(loop, edges.size(),
                     [&](std::size_t s) { edges[s] = inserter.findEdge(pslg.segments[s].a, pslg.segments[s].b); });
  const auto forSegments = [&](const auto& insert) {
    for (SegmentId s = 0; s < edges.size(); ++s) {
      try {
        insert(s);
      } catch (const Clash& clash) {
        refuse(clash, pslg, s);
      }
    }
  };
  forSegments([&](SegmentId s) {
    if (edges[s] != kNone) inserter.mark(edges[s], s);
  });
  forSegments([&](SegmentId s) {
    if (edges[s] == kNone) inserter.insert(pslg.segments[s].a, pslg.segments[s].b, s);
  });
}

// Edges suffice, since a Delaunay triangulation joins nearest neighbours.
void checkDistances(const Triangulation& triangulation, const ItemLoop& loop) {
  const std::span<const Triangle> triangles = triangulation.mesh.triangles;
  const auto isTooNear = [&](EdgeRef e) {
    const Point &a = triangulation.points[triangulation.mesh.origin(e)],
                &b = triangulation.points[triangulation.mesh.target(e)];
    return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)) < kLeastDistance;
  };
  const auto found = overStretches(loop, triangles.size(), [&](std::size_t first, std::size_t last) -> EdgeRef {
    for (TriId t = static_cast<TriId>(first); t < last; ++t)
      for (unsigned i = 0; i < 3 && !triangulation.isGhost(t); ++i)
        if (isTooNear(edgeRef(t, i))) return edgeRef(t, i);
    return kNone;
  });
  for (const EdgeRef e : found)
    if (e != kNone)
      refuse(PslgDefect::Kind::OutOfRange, triangulation.points[triangulation.mesh.origin(e)], kNone,
             "two vertices are nearer to one another than 1e-70");
}

// The triangles of the domain, ordered by their last corner along Hilbert's curve.
struct Numbering {
  BulkList<TriId> number;  // by slot; kNone outside the domain
  TriId count = 0;
};

Numbering numberAlongCurve(const Triangulation& triangulation, const BulkList<RegionId>& region, const ItemLoop& loop) {
  const std::size_t slots = region.size(), vertices = triangulation.along_curve.size();
  BulkList<std::uint32_t> place = unsetList<std::uint32_t>(vertices);
  forEachByStretches(loop, vertices,
                     [&](std::size_t i) { place[triangulation.along_curve[i]] = static_cast<std::uint32_t>(i); });
  const auto last = [&](TriId t) {
    const auto& v = triangulation.mesh.triangles[t].v;
    return std::max({place[v[0]], place[v[1]], place[v[2]]});
  };
  // Stretches of the curve, each of which is sorted by counting; a further part holds what is outside.
  constexpr std::size_t kVerticesInPart = 8192;
  const std::size_t parts = std::clamp<std::size_t>(vertices / kVerticesInPart, 1, 1024);
  const std::size_t in_part = (vertices + parts - 1) / parts;
  const Distribution sorted = distribute(loop, slots, parts + 1, [&](std::size_t t) {
    return region[t] == kOutside ? parts : last(static_cast<TriId>(t)) / in_part;
  });
  Numbering numbers{noNumbers(loop, slots), sorted.starts[parts]};
  forItems(loop, parts, [&](std::size_t p) {
    const auto own = std::span(sorted.items).subspan(sorted.starts[p], sorted.starts[p + 1] - sorted.starts[p]);
    const auto begin = static_cast<std::uint32_t>(p * in_part);
    std::vector<TriId> first(in_part + 1, 0);
    for (const TriId t : own) ++first[last(t) - begin + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    for (const TriId t : own) numbers.number[t] = sorted.starts[p] + first[last(t) - begin]++;
  });
  return numbers;
}

Triangulation triangulate(const Pslg& pslg, const Surface& surface, const ItemLoop& loop) {
  try {
    return triangulatePoints(pslg.points, surface, loop);
  } catch (const Clash& clash) {
    refuse(PslgDefect::Kind::PointsCoincide, pslg.points[clash.at], kNone, "two vertices lie at the same place");
  }
}

BulkList<RegionId> carve(const Triangulation& triangulation, const Pslg& pslg, const ItemLoop& loop) {
  try {
    return regionsOf(triangulation, pslg, loop);
  } catch (const LabelClash& clash) {
    const Segment& segment = pslg.segments[clash.segment];
    refuse(PslgDefect::Kind::LabelsContradict, midpoint(pslg.points[segment.a], pslg.points[segment.b]), clash.segment,
           "two segments label the same place differently", clash.other);
  }
}

}  // namespace

TriMesh constrainedDelaunay(const Pslg& pslg, const Surface& surface, const ItemLoop& loop) {
  checkReferences(pslg, loop);
  Triangulation triangulation = triangulate(pslg, surface, loop);
  if (!triangulation.hasTriangles())
    refuse(PslgDefect::Kind::NoArea, pslg.points.empty() ? Point{} : pslg.points.front(), kNone,
           "the vertices lie on one line and enclose no area");
  checkDistances(triangulation, loop);
  insertSegments(pslg, triangulation, loop);
  const BulkList<RegionId> region = carve(triangulation, pslg, loop);
  const Numbering numbers = numberAlongCurve(triangulation, region, loop);
  if (numbers.count == 0) refuse(PslgDefect::Kind::NoArea, pslg.points.front(), kNone, "the segments enclose no area");

  TriMesh mesh;
  resizeUnset(mesh.points, pslg.points.size());
  forEachByStretches(loop, pslg.points.size(), [&](std::size_t i) { mesh.points[i] = pslg.points[i]; });
  mesh.input_vertices = static_cast<VertexId>(pslg.points.size());
  resizeUnset(mesh.triangles, numbers.count);
  resizeUnset(mesh.regions, numbers.count);
  forEachByStretches(loop, region.size(), [&](std::size_t from) {
    const TriId to = numbers.number[from];
    if (to == kNone) return;
    mesh.triangles[to] = renumbered(
        triangulation.mesh.triangles[from], [&](TriId t) { return numbers.number[t]; }, std::identity());
    mesh.regions[to] = region[from];
  });
  assert(findBrokenLink(mesh.triangles) == kNone);
  return mesh;
}

}  // namespace coastmesh
