#include "gis/model/shore_for_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/delaunay.hpp"
#include "core/metric.hpp"
#include "core/tri_mesh.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/grid/loop_role.hpp"

namespace coastmesh {

namespace {

constexpr double kMostPieces = 1024.0;      // pieces of a segment
constexpr double kMostOfAll = 4'000'000.0;  // pieces of a domain
constexpr double kPiecesUnbounded = 16.0;   // pieces of a segment if the length of elements is unknown

// The segment between two vertices, by their numbers.
class SegmentSearch {
 public:
  explicit SegmentSearch(const Pslg& pslg) {
    for (SegmentId s = 0; s < pslg.segments.size(); ++s)
      index_.emplace_back(std::minmax(pslg.segments[s].a, pslg.segments[s].b), s);
    std::ranges::sort(index_);
  }
  SegmentId between(VertexId a, VertexId b) const {
    const std::pair<VertexId, VertexId> ends = std::minmax(a, b);
    const auto at = std::ranges::lower_bound(index_, ends, {}, [](const auto& entry) { return entry.first; });
    return at != index_.end() && at->first == ends ? at->second : kNone;
  }

 private:
  std::vector<std::pair<std::pair<VertexId, VertexId>, SegmentId>> index_;
};

// A piece of a segment, as shares of the way from its first end in the loop to its last.
struct Piece {
  SegmentId segment = kNone;  // kNone: a boundary edge without one
  VertexId from = kNone, to = kNone;
  double begin = 0.0, end = 1.0;
};

Point along(const Pslg& pslg, const Piece& piece, double share) {
  const Point &a = pslg.points[piece.from], &b = pslg.points[piece.to];
  return share <= 0.0 ? a : share >= 1.0 ? b : a + share * (b - a);
}

// The boundary in pieces about as long as the shortest elements.
class PiecedBoundary {
 public:
  PiecedBoundary(const Domain& domain, const Crs& crs, const ElementLengths& lengths)
      : domain_(domain), crs_(crs), lengths_(lengths), search_(domain.pslg), places_(domain.input_points) {
    const TriMesh mesh = constrainedDelaunay(domain.pslg);
    const auto loops = boundaryLoops(mesh);
    std::size_t count = 0;
    for (const auto& loop : loops) count += loop.size();
    most_ = std::clamp(kMostOfAll / static_cast<double>(std::max<std::size_t>(count, 1)), 1.0, kMostPieces);
    for (const auto& loop : loops) addLoop(loop);
  }

  BoundaryEdges edges;
  std::vector<Piece> pieces;  // one for each edge

  const std::vector<Point>& places() const { return places_; }

 private:
  void addLoop(const std::vector<VertexId>& loop) {
    const bool outer = roleOfLoop(domain_.input_points, loop, crs_) == BoundaryRole::Land;
    for (std::size_t i = 0; i < loop.size(); ++i) addEdge(loop[i], loop[(i + 1) % loop.size()], outer);
    edges.loop_ends.push_back(edges.edges.size());
  }

  void addEdge(VertexId from, VertexId to, bool outer) {
    const SegmentId segment = search_.between(from, to);
    const bool open = segment != kNone && domain_.pslg.segments[segment].tag == kOpenTag;
    const Point &a = domain_.pslg.points[from], &b = domain_.pslg.points[to];
    const double length_m = distance(a, b) / domain_.projection.scaleAt(a + 0.5 * (b - a));
    const double element_m = std::min(lengths_.most_m, length_m);
    double count = 1.0;
    if (!open && segment != kNone) {
      const double least_m = std::min(lengths_.least_m, lengths_.most_m);
      const double wanted = std::isfinite(least_m) ? std::ceil(length_m / least_m) : kPiecesUnbounded;
      count = wanted >= 1.0 ? std::min(wanted, std::floor(most_)) : 1.0;
    }
    const double share = std::min(1.0, length_m / count / element_m);
    std::uint32_t before = from;
    for (double k = 0.0; k < count; k += 1.0) {
      const Piece piece{segment, from, to, k / count, (k + 1.0) / count};
      std::uint32_t after = to;
      if (k + 1.0 < count) {
        after = static_cast<std::uint32_t>(places_.size());
        places_.push_back(domain_.projection.inverse(along(domain_.pslg, piece, piece.end)));
      }
      edges.edges.push_back({before, after});
      edges.kinds.push_back(open ? BoundaryKind{BoundaryRole::Open} : BoundaryKind{});
      edges.outer.push_back(outer);
      edges.share.push_back(std::isfinite(share) ? share : 1.0);
      pieces.push_back(piece);
      before = after;
    }
  }

  const Domain& domain_;
  const Crs& crs_;
  ElementLengths lengths_;
  SegmentSearch search_;
  std::vector<Point> places_;  // first those of the domain's points
  double most_ = 1.0;          // pieces of a segment
};

// Depths as the grid will have them, except for filled gaps and means over triangles, which do not exist yet.
std::vector<double> depthsAt(const std::vector<Point>& places, const Crs& crs, const DepthOptions& depths,
                             const RunControl& control, const ItemLoop& loop) {
  Grid nodes;
  nodes.crs = crs;
  nodes.nodes = places;
  DepthOptions options = depths;
  options.method = DepthMethod::Bilinear;
  options.fill = DepthFill::None;
  setDepths(nodes, options, control, loop);
  return std::move(nodes.z);
}

// The graph without the open pieces. `open` has a flag for each piece.
Pslg without(const Pslg& pslg, const std::vector<Piece>& pieces, const std::vector<bool>& open) {
  std::vector<bool> opens(pslg.segments.size(), false);
  for (std::size_t p = 0; p < pieces.size(); ++p)
    if (open[p]) opens[pieces[p].segment] = true;
  Pslg left;
  left.points = pslg.points;
  left.holes = pslg.holes;
  for (SegmentId s = 0; s < pslg.segments.size(); ++s)
    if (!opens[s]) left.segments.push_back(pslg.segments[s]);
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const SegmentId s = pieces[p].segment;
    if (s == kNone || !opens[s] || open[p]) continue;
    Piece run = pieces[p];
    while (p + 1 < pieces.size() && pieces[p + 1].segment == s && !open[p + 1]) run.end = pieces[++p].end;
    const auto pointAt = [&](double share) {
      if (share <= 0.0) return run.from;
      if (share >= 1.0) return run.to;
      left.points.push_back(along(pslg, run, share));
      return static_cast<VertexId>(left.points.size() - 1);
    };
    Segment segment = pslg.segments[s];
    const bool same = segment.a == run.from;
    const VertexId begin = pointAt(run.begin), end = pointAt(run.end);
    segment.a = same ? begin : end;
    segment.b = same ? end : begin;
    left.segments.push_back(segment);
  }
  return left;
}

}  // namespace

std::optional<Pslg> shoreForSizes(const Domain& domain, const Crs& crs, const BoundaryOptions& boundaries,
                                  const DepthOptions& depths, const ElementLengths& lengths, const RunControl& control,
                                  const ItemLoop& loop) {
  const bool has_rules = !boundaries.of_input.empty() || (boundaries.of_files && !boundaries.of_files->empty());
  const bool by_depth = boundaries.opensByDepth() && !depths.files.empty();
  if (domain.closed() || (!has_rules && !by_depth)) return std::nullopt;
  PiecedBoundary boundary(domain, crs, lengths);
  BoundaryEdges& edges = boundary.edges;
  BoundaryOptions options = boundaries;
  std::vector<double> z;
  if (by_depth) z = depthsAt(boundary.places(), crs, depths, control, loop);
  if (!by_depth) options.open_deeper_m = std::numeric_limits<double>::infinity();
  const std::vector<BoundaryKind> before = edges.kinds;
  const BoundaryPlaces at{crs, boundary.places(), z};
  defineKinds(at, options, edges);
  std::vector<bool> open(edges.edges.size());
  const auto isOpened = [&](std::size_t e) {
    return boundary.pieces[e].segment != kNone && before[e].role != BoundaryRole::Open &&
           edges.kinds[e].role == BoundaryRole::Open;
  };
  for (std::size_t e = 0; e < open.size(); ++e) open[e] = isOpened(e);
  // Short shores that are merged into openings remain shores here.
  mergeShort(at, options.least_length_m, edges);
  for (std::size_t e = 0; e < open.size(); ++e) open[e] = open[e] && isOpened(e);
  if (std::ranges::none_of(open, [](bool each) { return each; })) return std::nullopt;
  return without(domain.pslg, boundary.pieces, open);
}

}  // namespace coastmesh
