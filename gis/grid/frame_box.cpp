#include "gis/grid/frame_box.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/bulk_list.hpp"
#include "core/large_list.hpp"
#include "core/metric.hpp"
#include "core/quality.hpp"
#include "gis/coast/feature_bounds.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/grid/ground_orientation.hpp"
#include "gis/grid/local_plane.hpp"

namespace coastmesh {

FrameBox::FrameBox(const Coastline& coastline)
    : box_(boundsOfFrames(coastline)), in_parts_(std::ranges::any_of(coastline.features, [](const Feature& feature) {
        return feature.use == FeatureUse::Frame && feature.polygons.size() > 1;
      })) {}

Point FrameBox::nearest(const Point& p) const {
  return {in_parts_ ? p.x : std::clamp(p.x, box_.xmin, box_.xmax), std::clamp(p.y, box_.ymin, box_.ymax)};
}

bool FrameBox::hasOnSide(const Point& p) const {
  return p.y == box_.ymin || p.y == box_.ymax || (!in_parts_ && (p.x == box_.xmin || p.x == box_.xmax));
}

Point FrameBox::inwards(const Point& p) const {
  constexpr double kShare = 1e-4;  // of the box: more than rounding, and little beside the curvature of meridians
  const auto step = [](double at, double least, double greatest) {
    const double length = kShare * (greatest - least);
    return at == least ? length : at == greatest ? -length : 0.0;
  };
  return {p.x + (in_parts_ ? 0.0 : step(p.x, box_.xmin, box_.xmax)), p.y + step(p.y, box_.ymin, box_.ymax)};
}

namespace {

// Ascending indices of items for which `is_wanted`.
template <typename IsWanted>
std::vector<std::uint32_t> indicesOf(std::size_t count, const ItemLoop& loop, IsWanted&& is_wanted) {
  return joined(overStretches(loop, count, [&](std::size_t first, std::size_t last) {
    std::vector<std::uint32_t> some;
    for (std::size_t i = first; i < last; ++i)
      if (is_wanted(i)) some.push_back(static_cast<std::uint32_t>(i));
    return some;
  }));
}

std::array<double, 3> anglesOf(const Grid& grid, std::uint32_t triangle) {
  const auto p = localPlane(grid, grid.triangles[triangle]);
  return anglesDeg(p[0], p[1], p[2]);
}

class Mover {
 public:
  Mover(Grid& grid, std::vector<std::uint32_t>&& nodes, const AngleBounds& bounds, const ItemLoop& loop)
      : grid_(grid), loop_(loop), nodes_(std::move(nodes)), moves_(nodes_.size(), Move::Made) {
    BulkList<std::uint8_t> outside = filledList(loop, grid.nodes.size(), std::uint8_t{0});
    for (const std::uint32_t n : nodes_) outside[n] = 1, before_.push_back(grid.nodes[n]);
    triangles_ = indicesOf(grid.triangles.size(), loop, [&](std::size_t t) {
      return std::ranges::any_of(grid.triangles[t], [&](std::uint32_t n) { return outside[n] != 0; });
    });
    corners_.resize(triangles_.size());
    angles_.resize(triangles_.size());
    allowed_.resize(triangles_.size());
    forStretches(
        loop, triangles_.size(),
        [&](std::size_t first, std::size_t last) {
          for (std::size_t k = first; k < last; ++k) begin(k, bounds);
        },
        kWorthAStretch);
  }

  void move(const FrameBox& box) {
    for (const std::uint32_t n : nodes_) grid_.nodes[n] = box.nearest(grid_.nodes[n]);
    std::vector<std::uint8_t> spoilt(triangles_.size());
    const auto judge = [&](std::size_t first, std::size_t last) {
      for (std::size_t k = first; k < last; ++k) spoilt[k] = isSpoilt(k) ? 1 : 0;
    };
    forStretches(loop_, triangles_.size(), judge, kWorthAStretch);
    // Nodes that are put back may spoil triangles checked before. Each node is put back at most once.
    for (bool again = true; again;) {
      again = false;
      for (std::size_t k = 0; k < triangles_.size(); ++k) {
        if (!has(Move::Made, k) || !(has(Move::PutBack, k) ? isSpoilt(k) : spoilt[k] != 0)) continue;
        putBack(k);
        again = true;
      }
    }
  }

  // Also sets areas and angles of the triangles.
  FrameMoves moves() {
    FrameMoves moves;
    moves.nodes = static_cast<std::size_t>(std::ranges::count(moves_, Move::Made));
    std::vector<std::uint32_t> changed;
    for (std::size_t k = 0; k < triangles_.size(); ++k) {
      if (!has(Move::Made, k)) continue;
      changed.push_back(triangles_[k]);
      moves.angles_before.push_back(angles_[k]);
    }
    std::vector<std::array<std::uint32_t, 3>> corners(changed.size());
    moves.angles_after.resize(changed.size());
    const auto forChanged = [&](const auto& work) {
      const auto some = [&](std::size_t first, std::size_t last) {
        for (std::size_t k = first; k < last; ++k) work(k);
      };
      forStretches(loop_, changed.size(), some, kWorthAStretch);
    };
    forChanged([&](std::size_t k) {
      corners[k] = grid_.triangles[changed[k]];
      moves.angles_after[k] = anglesOf(grid_, changed[k]);
    });
    const std::vector<double> areas =
        grid_.area_m2.empty() ? std::vector<double>() : areasOfFew(grid_.nodes, corners, grid_.crs, loop_);
    forChanged([&](std::size_t k) {
      if (!areas.empty()) grid_.area_m2[changed[k]] = areas[k];
      if (!grid_.min_angle_deg.empty()) grid_.min_angle_deg[changed[k]] = std::ranges::min(moves.angles_after[k]);
    });
    return moves;
  }

 private:
  enum class Move : std::uint8_t { Made, PutBack };

  static constexpr std::size_t kWorthAStretch = 512;  // measuring angles takes long

  void begin(std::size_t k, const AngleBounds& bounds) {
    for (unsigned i = 0; i < 3; ++i) {
      const std::uint32_t n = grid_.triangles[triangles_[k]][i];
      const auto at = std::ranges::lower_bound(nodes_, n);
      corners_[k][i] = at != nodes_.end() && *at == n ? static_cast<std::uint32_t>(at - nodes_.begin()) : kNone;
    }
    angles_[k] = anglesOf(grid_, triangles_[k]);
    const auto [least, greatest] = std::ranges::minmax(angles_[k]);
    allowed_[k] = {std::min(bounds.least, least) - kAngleSlackDeg,
                   std::max(bounds.greatest, greatest) + kAngleSlackDeg};
  }

  bool has(Move move, std::size_t k) const {
    return std::ranges::any_of(corners_[k], [&](std::uint32_t i) { return i != kNone && moves_[i] == move; });
  }

  bool isSpoilt(std::size_t k) const {
    const auto& [a, b, c] = grid_.triangles[triangles_[k]];
    if (orientationOnGround(grid_.nodes[a], grid_.nodes[b], grid_.nodes[c], grid_.crs) <= 0) return true;
    const auto [least, greatest] = std::ranges::minmax(anglesOf(grid_, triangles_[k]));
    return least < allowed_[k].least || greatest > allowed_[k].greatest;
  }

  void putBack(std::size_t k) {
    for (const std::uint32_t i : corners_[k]) {
      if (i == kNone || moves_[i] != Move::Made) continue;
      grid_.nodes[nodes_[i]] = before_[i];
      moves_[i] = Move::PutBack;
    }
  }

  Grid& grid_;
  const ItemLoop& loop_;
  std::vector<std::uint32_t> nodes_;      // outside the box, ascending
  std::vector<Point> before_;             // where they were
  std::vector<Move> moves_;               // of each of these
  std::vector<std::uint32_t> triangles_;  // with such nodes
  // Of each of these triangles: its corners among `nodes_`, kNone for others; its angles before.
  std::vector<std::array<std::uint32_t, 3>> corners_;
  std::vector<std::array<double, 3>> angles_;
  std::vector<AngleBounds> allowed_;
};

using VertexPair = std::pair<VertexId, VertexId>;

// The edges at the boundary of a mesh, or with a segment, from both of their ends.
class ChainEdges {
 public:
  explicit ChainEdges(const TriMesh& mesh) {
    for (TriId t = 0; t < mesh.triangles.size(); ++t) {
      for (unsigned i = 0; i < 3; ++i) {
        const EdgeRef e = edgeRef(t, i);
        if (mesh.twin(e) != kNone && (mesh.segment(e) == kNone || mesh.twin(e) < e)) continue;
        halves_.emplace_back(mesh.origin(e), mesh.target(e));
        halves_.emplace_back(mesh.target(e), mesh.origin(e));
      }
    }
    std::ranges::sort(halves_);
  }

  std::span<const VertexPair> from(VertexId v) const {
    const auto range = std::ranges::equal_range(halves_, v, {}, &VertexPair::first);
    return {range.begin(), range.end()};
  }

 private:
  std::vector<VertexPair> halves_;
};

// A run of edges through points that are no vertices of the input, and the vertices at its ends, or kNone.
struct Chain {
  std::vector<VertexId> points;
  std::array<VertexId, 2> ends;
};

// REQUIRES: two edges from `start`.
Chain chainThrough(VertexId start, const ChainEdges& edges, std::span<const VertexId> vertex_of) {
  Chain chain{{start}, {kNone, kNone}};
  for (const unsigned k : {0u, 1u}) {
    VertexId before = start, at = edges.from(start)[k].second;
    // A ring without a vertex of the input comes back to the start.
    while (at != start && vertex_of[at] == kNone) {
      chain.points.push_back(at);
      const std::span<const VertexPair> on = edges.from(at);
      if (on.size() != 2) break;
      before = std::exchange(at, on[on[0].second == before ? 1 : 0].second);
    }
    chain.ends[k] = vertex_of[at];
  }
  return chain;
}

std::vector<VertexPair> sortedSegments(const Pslg& pslg) {
  std::vector<VertexPair> pairs;
  pairs.reserve(pslg.segments.size());
  for (const Segment& s : pslg.segments) pairs.emplace_back(std::minmax(s.a, s.b));
  std::ranges::sort(pairs);
  return pairs;
}

// Where the line through `p` in the direction `way` meets the segment from a to b; the nearest place if they are as
// good as parallel.
Point placeOnSegment(const Point& p, const Point& way, const Point& a, const Point& b) {
  constexpr double kParallel = 1e-6;
  const Point along = b - a;
  const double turn = cross(along, way);
  const bool parallel = std::abs(turn) <= kParallel * std::sqrt(squaredLength(along) * squaredLength(way));
  const double share = parallel ? dot(p - a, along) / squaredLength(along) : cross(p - a, way) / turn;
  return a + std::clamp(share, 0.0, 1.0) * along;
}

}  // namespace

FrameMoves keepInFrame(Grid& grid, const Coastline& coastline, const AngleBounds& bounds, const ItemLoop& loop) {
  if (!coastline.framed_by_box) return {};
  const FrameBox box(coastline);
  std::vector<std::uint32_t> outside =
      indicesOf(grid.nodes.size(), loop, [&](std::size_t n) { return !(box.nearest(grid.nodes[n]) == grid.nodes[n]); });
  if (outside.empty()) return {};
  Mover mover(grid, std::move(outside), bounds, loop);
  mover.move(box);
  return mover.moves();
}

std::vector<std::uint8_t> undoMovesToFrame(TriMesh& mesh, std::span<const Point> nodes, const FrameBox& box,
                                           const Pslg& pslg, std::span<const VertexId> vertex_of,
                                           const Projection& projection) {
  const auto count = static_cast<VertexId>(mesh.points.size());
  std::vector<std::uint8_t> moved(count, 0);
  for (VertexId v = 0; v < count; ++v) moved[v] = vertex_of[v] == kNone && box.hasOnSide(nodes[v]) ? 1 : 0;
  if (std::ranges::find(moved, 1) == moved.end()) return moved;
  const ChainEdges edges(mesh);
  const std::vector<VertexPair> segments = sortedSegments(pslg);
  std::vector<std::uint8_t> seen(count, 0);
  for (VertexId v = 0; v < count; ++v) {
    if (moved[v] == 0 || seen[v] != 0 || edges.from(v).size() != 2) continue;
    const Chain chain = chainThrough(v, edges, vertex_of);
    for (const VertexId point : chain.points) seen[point] = 1;
    if (!std::ranges::binary_search(segments, VertexPair(std::minmax(chain.ends[0], chain.ends[1])))) continue;
    const Point &a = pslg.points[chain.ends[0]], &b = pslg.points[chain.ends[1]];
    for (const VertexId point : chain.points) {
      if (moved[point] == 0) continue;
      Point& place = mesh.points[point];
      place = placeOnSegment(place, projection.forward(box.inwards(nodes[point])) - place, a, b);
      moved[point] = 0;
    }
  }
  return moved;
}

}  // namespace coastmesh
