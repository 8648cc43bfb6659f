#include "gis/coast_follow.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/label_regions.hpp"
#include "core/metric.hpp"
#include "gis/box_tree.hpp"
#include "gis/clean_chains.hpp"
#include "gis/clean_faces.hpp"
#include "gis/clean_simplify.hpp"
#include "gis/domain_of_edges.hpp"
#include "gis/segment_tags.hpp"

namespace coastmesh {

namespace {

// How far the shore may be moved, as a share of the size wanted there.
constexpr double kShareMoved = 0.25;
// The same for the rim of open water, which nature did not draw: its sides have vertices for the curve that they are in the plane.
constexpr double kShareOfOpenMoved = 0.01;
// Where that rim turns by more than this it has a corner, which stays.
constexpr double kCosineOfCorner = 0.985;  // of 10 degrees
// An island that is longer than so many elements stays, however thin.
constexpr double kLongestIsland = 3.0;

bool isRim(const Segment& s) { return (s.left >= 0) != (s.right >= 0); }
bool isShore(const Segment& s) { return s.tag != kOpenTag && isRim(s); }

// Marks the segments of islands that are smaller than an equilateral triangle of the size wanted there.
class IslandSearch {
 public:
  IslandSearch(const Domain& domain, const SizeFunction& size) : pslg_(domain.pslg), size_(size) {
    next_.assign(pslg_.points.size(), kNone);
    degree_.assign(pslg_.points.size(), 0);
    std::vector<Box> boxes(pslg_.points.size());
    for (SegmentId s = 0; s < pslg_.segments.size(); ++s) {
      const Segment& segment = pslg_.segments[s];
      // On with the water to the left.
      if (isShore(segment)) next_[segment.left >= 0 ? segment.a : segment.b] = s;
      for (const VertexId v : {segment.a, segment.b}) ++degree_[v];
    }
    for (VertexId v = 0; v < boxes.size(); ++v) boxes[v].add(pslg_.points[v]);
    tree_ = BoxTree(boxes, BoxTree::Order::Hilbert);
  }

  std::vector<bool> run(const Coastline& coastline, const Domain& domain, CleanReport& report) {
    std::vector<bool> goes(pslg_.segments.size(), false);
    std::vector<bool> seen(pslg_.points.size(), false);
    for (VertexId v = 0; v < pslg_.points.size(); ++v) {
      if (seen[v] || next_[v] == kNone || !walk(v, seen) || !isSmall()) continue;
      for (const VertexId w : loop_) goes[next_[w]] = true;
      const Segment& first = pslg_.segments[next_[v]];
      report.add(EditKind::SmallIsland, domain.input_points[v],
                 coastline.features[static_cast<std::size_t>(std::max(first.left, first.right))].fid);
    }
    return goes;
  }

 private:
  // The loop of shore from v on; false where it is not one on its own.
  bool walk(VertexId v, std::vector<bool>& seen) {
    loop_.clear();
    bool alone = true;
    for (VertexId w = v; !seen[w];) {
      seen[w] = true;
      loop_.push_back(w);
      alone = alone && degree_[w] == 2;
      if (next_[w] == kNone) return false;
      const Segment& s = pslg_.segments[next_[w]];
      w = s.left >= 0 ? s.b : s.a;
      if (w == v) return alone;
    }
    return false;
  }

  bool isSmall() const {
    double doubled = 0.0;
    Box box;
    Point sum;
    for (std::size_t i = 0; i < loop_.size(); ++i) {
      const Point &a = at(i), &b = at(i + 1 == loop_.size() ? 0 : i + 1);
      doubled += cross(a - at(0), b - at(0));
      box.add(a);
      sum = sum + a;
    }
    if (doubled >= 0.0) return false;  // the water is inside: no island
    const double size = size_.at((1.0 / static_cast<double>(loop_.size())) * sum);
    if (-0.5 * doubled >= 0.25 * std::numbers::sqrt3 * size * size) return false;
    if (std::max(box.xmax - box.xmin, box.ymax - box.ymin) > kLongestIsland * size) return false;
    // Nor may anything lie on it.
    bool empty = true;
    tree_.visit(box,
                [&](std::uint32_t v) { empty = empty && (std::ranges::find(loop_, v) != loop_.end() || !holds(v)); });
    return empty;
  }

  bool holds(VertexId v) const {
    const Point& x = pslg_.points[v];
    bool inside = false;
    for (std::size_t i = 0; i < loop_.size(); ++i) {
      const Point &a = at(i), &b = at(i + 1 == loop_.size() ? 0 : i + 1);
      if ((a.y > x.y) != (b.y > x.y) && x.x < a.x + (x.y - a.y) / (b.y - a.y) * (b.x - a.x)) inside = !inside;
    }
    return inside;
  }

  const Point& at(std::size_t i) const { return pslg_.points[loop_[i]]; }

  const Pslg& pslg_;
  const SizeFunction& size_;
  std::vector<SegmentId> next_;  // the shore that leaves a vertex, water to its left
  std::vector<std::uint32_t> degree_;
  std::vector<VertexId> loop_;
  BoxTree tree_;
};

bool isCorner(const Point& from, const Point& at, const Point& to) {
  const Point in = at - from, out = to - at;
  return dot(in, out) < kCosineOfCorner * std::sqrt(squaredLength(in) * squaredLength(out));
}

// How far each vertex may be moved, as a share of the size wanted there; below 0: not at all.
std::vector<double> sharesMoved(const Pslg& pslg) {
  std::vector<double> share(pslg.points.size(), kShareMoved);
  std::vector<VertexId> open_beside(pslg.points.size(), kNone);
  for (const Segment& s : pslg.segments) {
    if (isShore(s)) continue;
    for (const auto& [v, w] : {std::pair(s.a, s.b), std::pair(s.b, s.a)}) {
      const VertexId before = std::exchange(open_beside[v], w);
      const bool stays =
          !isRim(s) || (before != kNone && isCorner(pslg.points[before], pslg.points[v], pslg.points[w]));
      share[v] = std::min(share[v], stays ? -1.0 : kShareOfOpenMoved);
    }
  }
  return share;
}

}  // namespace

Domain followSizes(Domain&& domain, const SizeFunction& size, const Coastline& coastline, CleanReport& report) {
  labelSegments(domain.pslg);
  std::vector<bool> goes = IslandSearch(domain, size).run(coastline, domain, report);
  LabelledEdges edges;
  edges.lines = std::move(domain.lines);
  std::vector<bool> was_used(domain.pslg.points.size(), false);
  const std::vector<double> share = sharesMoved(domain.pslg);
  for (SegmentId s = 0; s < domain.pslg.segments.size(); ++s) {
    const Segment& segment = domain.pslg.segments[s];
    was_used[segment.a] = was_used[segment.b] = true;
    if (goes[s]) continue;
    edges.segments.push_back(segment);
  }
  for (VertexId v = 0; v < was_used.size(); ++v)
    if (!was_used[v]) edges.points.push_back(v);

  const CleanVertices vertices{std::move(domain.pslg.points), std::move(domain.input_points), {}};
  const auto tolerance = [&](VertexId v) { return share[v] < 0.0 ? -1.0 : share[v] * size.at(vertices.plane[v]); };
  edges.segments = simplifyEdges(vertices, edges, coastline, domain.resolution, tolerance, report);

  return domainOf(vertices, std::move(edges), domain.projection, domain.resolution);
}

}  // namespace coastmesh
