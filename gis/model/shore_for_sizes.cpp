#include "gis/model/shore_for_sizes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/metric.hpp"
#include "core/tri_mesh.hpp"
#include "core/triangulate/delaunay.hpp"
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
    const bool open = segment != kNone && isOpenTag(domain_.pslg.segments[segment].tag);
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
  nodes.nodes.assign(places.begin(), places.end());
  DepthOptions options = depths;
  options.method = DepthMethod::Bilinear;
  options.fill = DepthFill::None;
  setDepths(nodes, options, control, loop);
  return std::move(nodes.z);
}

// The pieces of a boundary that files or depths open.
struct Openings {
  std::vector<Piece> pieces;
  std::vector<bool> opened;  // of each piece
};

struct DividedGraph {
  Pslg pslg;
  std::vector<bool> opened;  // of each segment
};

// The graph with segments divided where openings begin or end. New points follow those of `pslg`.
DividedGraph divided(const Pslg& pslg, const Openings& openings) {
  const std::vector<Piece>& pieces = openings.pieces;
  std::vector<bool> has_opening(pslg.segments.size(), false);
  for (std::size_t p = 0; p < pieces.size(); ++p)
    if (openings.opened[p]) has_opening[pieces[p].segment] = true;
  DividedGraph result;
  result.pslg.points = pslg.points;
  result.pslg.holes = pslg.holes;
  for (SegmentId s = 0; s < pslg.segments.size(); ++s)
    if (!has_opening[s]) result.pslg.segments.push_back(pslg.segments[s]);
  result.opened.assign(result.pslg.segments.size(), false);
  VertexId end = kNone;  // of the run before
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    const SegmentId s = pieces[p].segment;
    if (s == kNone || !has_opening[s]) continue;
    Piece run = pieces[p];
    const bool opened = openings.opened[p];
    while (p + 1 < pieces.size() && pieces[p + 1].segment == s && openings.opened[p + 1] == opened)
      run.end = pieces[++p].end;
    const VertexId begin = run.begin <= 0.0 ? run.from : end;
    if (run.end >= 1.0) {
      end = run.to;
    } else {
      end = static_cast<VertexId>(result.pslg.points.size());
      result.pslg.points.push_back(along(pslg, run, run.end));
    }
    Segment segment = pslg.segments[s];
    const bool same = segment.a == run.from;
    segment.a = same ? begin : end;
    segment.b = same ? end : begin;
    result.pslg.segments.push_back(segment);
    result.opened.push_back(opened);
  }
  return result;
}

// What files or depths open in addition to what is open by its tag; nullopt if nothing.
std::optional<Openings> openingsOf(const Domain& domain, const Crs& crs, const BoundaryOptions& boundaries,
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
  defineKinds(at, options, edges, loop);
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
  return Openings{std::move(boundary.pieces), std::move(open)};
}

}  // namespace

std::optional<Pslg> shoreForSizes(const Domain& domain, const Crs& crs, const BoundaryOptions& boundaries,
                                  const DepthOptions& depths, const ElementLengths& lengths, const RunControl& control,
                                  const ItemLoop& loop) {
  const auto openings = openingsOf(domain, crs, boundaries, depths, lengths, control, loop);
  if (!openings) return std::nullopt;
  DividedGraph graph = divided(domain.pslg, *openings);
  std::vector<Segment> shore;
  for (SegmentId s = 0; s < graph.opened.size(); ++s)
    if (!graph.opened[s]) shore.push_back(graph.pslg.segments[s]);
  graph.pslg.segments = std::move(shore);
  return std::move(graph.pslg);
}

Domain withOpenings(Domain&& domain, const Crs& crs, const BoundaryOptions& boundaries, const DepthOptions& depths,
                    const ElementLengths& lengths, const RunControl& control, const ItemLoop& loop) {
  const auto openings = openingsOf(domain, crs, boundaries, depths, lengths, control, loop);
  if (!openings) return std::move(domain);
  DividedGraph graph = divided(domain.pslg, *openings);
  for (SegmentId s = 0; s < graph.opened.size(); ++s)
    if (graph.opened[s]) graph.pslg.segments[s].tag = kOpenedTag;
  for (std::size_t v = domain.pslg.points.size(); v < graph.pslg.points.size(); ++v)
    domain.input_points.push_back(domain.projection.inverse(graph.pslg.points[v]));
  domain.pslg = std::move(graph.pslg);
  return std::move(domain);
}

}  // namespace coastmesh
