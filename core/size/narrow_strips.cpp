#include "core/size/narrow_strips.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "core/metric.hpp"

namespace coastmesh {

namespace {

constexpr double kNarrow = 8.0;     // lengths: a segment is long whose opposite vertex is closer than this share of it
constexpr double kWide = 0.25;      // of a segment's length: where the gap is wider, it takes next to nothing
constexpr double kPerPiece = 0.47;  // vertices, as measured
constexpr std::size_t kMostSteps = 100000;  // along the opposite shore, in each direction

double lengthOf(const TriMesh& mesh, EdgeRef e) {
  return std::sqrt(squaredDistance(mesh.point(mesh.origin(e)), mesh.point(mesh.target(e))));
}

// Of an edge on a segment, to the opposite vertex of its triangle.
double gapOver(const TriMesh& mesh, EdgeRef e) {
  const Point &a = mesh.point(mesh.origin(e)), &b = mesh.point(mesh.target(e));
  return std::abs(cross(b - a, mesh.point(mesh.apex(e)) - a)) / lengthOf(mesh, e);
}

// Calls act(edge, pieces) for long edges beside a near vertex, with the number of pieces as long as that is far.
template <typename Act>
void forLongEdges(const TriMesh& mesh, std::size_t first, std::size_t last, Act&& act) {
  for (std::size_t t = first; t < last; ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(static_cast<TriId>(t), i);
      if (mesh.segment(e) == kNone) continue;
      const double length = lengthOf(mesh, e), gap = gapOver(mesh, e);
      if (length > kNarrow * gap && gap > 0.0) act(e, length / gap);
    }
  }
}

// Neighbours of vertices along segments.
class Shores {
 public:
  explicit Shores(const TriMesh& mesh) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      for (unsigned i = 0; i < 3; ++i) {
        const EdgeRef e = edgeRef(static_cast<TriId>(t), i);
        if (mesh.segment(e) == kNone) continue;
        ends_.emplace_back(mesh.origin(e), mesh.target(e));
        ends_.emplace_back(mesh.target(e), mesh.origin(e));
      }
    std::ranges::sort(ends_);
  }

  template <typename Act>
  void forNeighbours(VertexId v, Act&& act) const {
    for (auto at = std::ranges::lower_bound(ends_, std::pair(v, VertexId{0})); at != ends_.end() && at->first == v;
         ++at)
      act(at->second);
  }

 private:
  std::vector<std::pair<VertexId, VertexId>> ends_;
};

// The strip between a segment and the shore opposite.
struct Strip {
  double pieces = 0.0, length = 0.0;
  double width = 0.0;  // least
  Point place;
};

class StripAlong {
 public:
  StripAlong(const TriMesh& mesh, const Shores& shores, EdgeRef e)
      : mesh_(mesh),
        shores_(shores),
        ends_{mesh.origin(e), mesh.target(e)},
        from_(mesh.point(ends_[0])),
        length_(lengthOf(mesh, e)) {
    const Point& to = mesh.point(mesh.target(e));
    along_ = {(to.x - from_.x) / length_, (to.y - from_.y) / length_};
    const VertexId apex = mesh.apex(e);
    const Point start = placeOf(apex);
    strip_.width = length_;
    for (const double direction : {1.0, -1.0}) walk(apex, start, direction);
  }

  const Strip& strip() const { return strip_; }

 private:
  // Along the segment, and away from it.
  Point placeOf(VertexId v) const {
    const Point p = mesh_.point(v) - from_;
    return {dot(p, along_), cross(along_, p)};
  }

  // Follows the shore from `v` as long as it is beside the segment.
  void walk(VertexId v, Point at, double direction) {
    for (std::size_t steps = 0; steps < kMostSteps; ++steps) {
      const double rest = direction > 0.0 ? length_ - at.x : at.x;
      if (rest <= 0.0 || at.y > kWide * length_) return;
      const auto next = nextOf(v, at, direction);
      if (!next) {
        // The size of triangles grows with the distance from the shore's end. Refinement leaves a wedge that ends where
        // the segment does as sharp as it is.
        if (!meetsSegment(v)) strip_.pieces += std::log1p(std::min(rest, length_) / at.y);
        return;
      }
      add(at, next->second);
      v = next->first, at = next->second;
    }
  }

  bool isEnd(VertexId v) const { return v == ends_[0] || v == ends_[1]; }
  bool meetsSegment(VertexId v) const {
    bool meets = false;
    shores_.forNeighbours(v, [&](VertexId other) { meets = meets || isEnd(other); });
    return meets;
  }

  // The neighbour that leads away from the segment least.
  std::optional<std::pair<VertexId, Point>> nextOf(VertexId v, const Point& at, double direction) const {
    std::optional<std::pair<VertexId, Point>> next;
    double least = 0.0;
    shores_.forNeighbours(v, [&](VertexId other) {
      const Point place = placeOf(other);
      const double forward = direction * (place.x - at.x);
      if (isEnd(other) || !(forward > 0.0) || !(place.y > 0.0)) return;
      const double slope = (place.y - at.y) / forward;
      if (slope > 1.0 || (next && slope >= least)) return;
      least = slope;
      next = {other, place};
    });
    return next;
  }

  // Adds the integral of 1 / gap over a piece of the shore opposite, as far as it is beside the segment.
  void add(const Point& a, const Point& b) {
    const double slope = (b.y - a.y) / (b.x - a.x);
    const auto clipped = [&](const Point& p) {
      const double x = std::clamp(p.x, 0.0, length_);
      return Point{x, p.y + slope * (x - p.x)};
    };
    const Point from = clipped(a), to = clipped(b);
    const double part = std::abs(to.x - from.x), change = std::log(to.y / from.y);
    constexpr double kParallel = 1e-9;
    strip_.pieces += std::abs(change) < kParallel ? part / from.y : part * change / (to.y - from.y);
    // Where the other shore is long too, the strip is seen from both.
    const double least = std::min(from.y, to.y), greatest = std::max(from.y, to.y);
    const bool both = std::abs(b.x - a.x) > kNarrow * greatest;
    if (least < length_ / kNarrow) strip_.length += both ? 0.5 * part : part;
    if (least > strip_.width) return;
    const Point& narrowest = from.y < to.y ? from : to;
    strip_.width = least;
    strip_.place = {from_.x + narrowest.x * along_.x - 0.5 * least * along_.y,
                    from_.y + narrowest.x * along_.y + 0.5 * least * along_.x};
  }

  const TriMesh& mesh_;
  const Shores& shores_;
  std::array<VertexId, 2> ends_;
  Point from_, along_;
  double length_;
  Strip strip_;
};

}  // namespace

NarrowStrips narrowStrips(const TriMesh& mesh, double worth, const ItemLoop& loop) {
  const std::size_t count = mesh.triangles.size();
  const std::vector<double> sums = overStretches(loop, count, [&](std::size_t first, std::size_t last) {
    double sum = 0.0;
    forLongEdges(mesh, first, last, [&sum](EdgeRef, double pieces) { sum += pieces; });
    return sum;
  });
  const double most = std::accumulate(sums.begin(), sums.end(), 0.0);
  const double least = std::max(worth, static_cast<double>(mesh.points.size()));
  NarrowStrips strips;
  if (!(most >= least)) return strips;
  const Shores shores(mesh);
  double greatest = 0.0;
  forLongEdges(mesh, 0, count, [&](EdgeRef e, double) {
    const Strip strip = StripAlong(mesh, shores, e).strip();
    strips.vertices += kPerPiece * strip.pieces;
    strips.length += strip.length;
    if (strip.pieces <= greatest) return;
    greatest = strip.pieces;
    strips.place = strip.place;
    strips.width = strip.width;
    strips.region = mesh.regions[triOf(e)];
  });
  return strips.vertices >= least ? strips : NarrowStrips{};
}

}  // namespace coastmesh
