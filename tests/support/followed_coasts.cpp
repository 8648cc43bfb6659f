#include "tests/support/followed_coasts.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "core/metric.hpp"
#include "core/triangulate/delaunay.hpp"
#include "gis/follow/water_notes.hpp"

namespace coastmesh {

Coastline oneFeature() {
  Coastline coast;
  coast.features.emplace_back();
  return coast;
}

void addRing(Domain& domain, const Point& centre, double radius, int points, bool is_island, double wiggle) {
  const auto first = static_cast<VertexId>(domain.pslg.points.size());
  const auto count = static_cast<VertexId>(points);
  for (VertexId i = 0; i < count; ++i) {
    const double angle = 6.283185307179586 * i / points, r = radius * (1.0 + (i % 2 ? wiggle : 0.0));
    domain.pslg.points.push_back(centre + Point{r * std::cos(angle), r * std::sin(angle)});
    Segment s{first + i, first + (i + 1) % count, 0, 0, kOutside};
    if (is_island) std::swap(s.left, s.right);
    domain.pslg.segments.push_back(s);
  }
  domain.input_points = domain.pslg.points;
}

void addShore(Domain& domain, const std::vector<Point>& ring) {
  const auto first = static_cast<VertexId>(domain.pslg.points.size()), count = static_cast<VertexId>(ring.size());
  for (VertexId i = 0; i < count; ++i) {
    domain.pslg.points.push_back(ring[i]);
    domain.pslg.segments.push_back({first + i, first + (i + 1) % count, 0, 0, kOutside});
  }
  domain.input_points = domain.pslg.points;
}

Domain twoLakes(double width) {
  const double low = 10.0 - width / 2, high = 10.0 + width / 2;
  Domain domain;
  addShore(domain, {{0, 0},
                    {20, 0},
                    {20, low},
                    {30, low},
                    {30, 0},
                    {50, 0},
                    {50, 20},
                    {30, 20},
                    {30, high},
                    {20, high},
                    {20, 20},
                    {0, 20}});
  return domain;
}

std::size_t countOf(const CleanReport& report, EditKind kind) { return report.counts[static_cast<std::size_t>(kind)]; }

void addWaterNotes(CleanReport& report, const FollowOptions& options) {
  NotesAndWarnings texts = noteWaters(report.waters, options);
  std::ranges::move(texts.notes, std::back_inserter(report.notes));
  std::ranges::move(texts.warnings, std::back_inserter(report.warnings));
}

double areaOf(const Domain& domain) {
  double area = 0.0;
  for (const Segment& s : domain.pslg.segments) {
    const Point &a = domain.pslg.points[s.a], &b = domain.pslg.points[s.b];
    if (s.left >= 0) area += 0.5 * cross(a, b);
    if (s.right >= 0) area -= 0.5 * cross(a, b);
  }
  return area;
}

std::size_t parts(const Domain& domain) {
  const TriMesh mesh = constrainedDelaunay(domain.pslg);
  std::vector<bool> seen(mesh.triangles.size(), false);
  std::size_t count = 0;
  for (TriId t = 0; t < seen.size(); ++t) {
    if (seen[t]) continue;
    ++count;
    std::vector<TriId> stack{t};
    seen[t] = true;
    while (!stack.empty()) {
      const TriId at = stack.back();
      stack.pop_back();
      for (const EdgeRef e : mesh.triangles[at].adj) {
        if (e == kNone || seen[triOf(e)]) continue;
        seen[triOf(e)] = true;
        stack.push_back(triOf(e));
      }
    }
  }
  return count;
}

double leastApart(const Domain& domain) {
  double least = 1e300;
  for (const Segment& s : domain.pslg.segments) {
    for (VertexId v = 0; v < domain.pslg.points.size(); ++v) {
      if (v == s.a || v == s.b) continue;
      least = std::min(
          least, squaredDistanceToSegment(domain.pslg.points[v], domain.pslg.points[s.a], domain.pslg.points[s.b]));
    }
  }
  return std::sqrt(least);
}

}  // namespace coastmesh
