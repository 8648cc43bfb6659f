#include "gis/weirs/crest_transects.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/metric.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/raster/raster_turn.hpp"
#include "gis/sample/sample_raster.hpp"
#include "gis/weirs/line_view.hpp"

namespace coastmesh {
namespace {

using Segment2 = std::array<Point, 2>;

LineView viewOf(const Grid& grid, const NodePair& nodes) {
  return {placeBetween(grid.crs, grid.nodes[nodes[0]], grid.nodes[nodes[1]], 0.5), grid.crs.geographic};
}

double norm(const Point& p) { return std::sqrt(squaredLength(p)); }

// The segments of the source that can be nearest to a place of the edge: no farther from its middle than the nearest
// one and the edge's length.
std::vector<Segment2> segmentsBeside(const CrestEdge& edge, const LineView& view) {
  std::vector<std::pair<double, Segment2>> all;
  double least = std::numeric_limits<double>::infinity();
  for (const std::vector<Point>& line : edge.source->lines) {
    for (std::size_t i = 1; i < line.size(); ++i) {
      const Point a = view.of(line[i - 1]), b = view.of(line[i]);
      if (a == b) continue;
      all.emplace_back(std::sqrt(squaredDistanceToSegment({}, a, b)), Segment2{a, b});
      least = std::min(least, all.back().first);
    }
  }
  std::vector<Segment2> beside;
  for (const auto& [distance, segment] : all)
    if (distance <= least + edge.length) beside.push_back(segment);
  return beside;
}

// Sets `pixels` and `rasters` of the edges for one raster. `probes`: of each edge its middle, and places `search_m` to
// the east and north of it, in pixels.
void takeRaster(std::vector<CrestEdge>& edges, const std::vector<Point>& probes, const RasterGeometry& raster,
                double turn, double search_m) {
  const auto apart = [turn](const Point& a, const Point& b) {
    const double dx = b.x - a.x;
    return norm({turn > 0.0 ? std::remainder(dx, turn) : dx, b.y - a.y});
  };
  for (std::size_t e = 0; e < edges.size(); ++e) {
    CrestEdge& edge = edges[e];
    const Point* const at = &probes[3 * e];
    const double step = std::max(search_m, 1.0) * edge.metre;
    const double pixels = std::max(apart(at[0], at[1]), apart(at[0], at[2])) / step;
    const double reach = pixels * (0.5 * edge.length + step) + 1.0;
    const auto holds = [&](double x) { return x >= -reach && x <= raster.columns + reach; };
    const bool is_near = std::isfinite(pixels) && at[0].y >= -reach && at[0].y <= raster.rows + reach &&
                         (holds(at[0].x) || (turn > 0.0 && (holds(at[0].x - turn) || holds(at[0].x + turn))));
    edge.rasters.push_back(is_near);
    if (is_near) edge.pixels = std::max(edge.pixels, pixels);
  }
}

}  // namespace

std::uint32_t CrestEdge::transects() const {
  return 2 * static_cast<std::uint32_t>(std::max(1.0, std::ceil(0.5 * length * pixels)));
}

std::uint32_t CrestEdge::places(double search_m) const {
  return static_cast<std::uint32_t>(std::ceil(2.0 * search_m * metre * pixels)) + 1;
}

std::vector<CrestEdge> crestEdges(const Grid& grid, std::span<const std::pair<NodePair, const WeirSource*>> edges,
                                  const std::vector<RasterBand>& rasters, double search_m, const ItemLoop& loop) {
  std::vector<CrestEdge> all;
  std::vector<Point> ends, probes;
  for (const auto& [nodes, source] : edges) ends.insert(ends.end(), {grid.nodes[nodes[0]], grid.nodes[nodes[1]]});
  const EdgeMeter meter(ends, grid.crs, loop);
  for (const auto& [nodes, source] : edges) {
    const LineView view = viewOf(grid, nodes);
    CrestEdge& edge = all.emplace_back(CrestEdge{nodes, source});
    edge.length = distance(view.of(grid.nodes[nodes[0]]), view.of(grid.nodes[nodes[1]]));
    const auto first = static_cast<std::uint32_t>(2 * (all.size() - 1));
    edge.metre = edge.length / meter.between(first, first + 1);
    const double step = std::max(search_m, 1.0) * edge.metre;
    for (const Point& probe : {Point{0.0, 0.0}, Point{step, 0.0}, Point{0.0, step}})
      probes.push_back(view.placeOf(probe));
  }
  for (const RasterBand& raster : rasters)
    takeRaster(all, pixelsOf(grid.crs, probes, raster, loop), raster.geometry(),
               columnsOfTurn(raster.geometry(), grid.crs), search_m);
  return all;
}

std::vector<std::array<Point, 2>> transectsOf(const Grid& grid, const CrestEdge& edge, double search_m) {
  const LineView view = viewOf(grid, edge.nodes);
  const Point from = view.of(grid.nodes[edge.nodes[0]]), to = view.of(grid.nodes[edge.nodes[1]]);
  std::vector<Segment2> beside = segmentsBeside(edge, view);
  if (beside.empty()) beside.push_back({from, to});
  std::vector<std::array<Point, 2>> transects;
  const std::uint32_t count = edge.transects();
  for (std::uint32_t k = 0; k < count; ++k) {
    const Point place = from + ((k + 0.5) / count) * (to - from);
    const Segment2& nearest = *std::ranges::min_element(
        beside, {}, [&](const Segment2& s) { return squaredDistanceToSegment(place, s[0], s[1]); });
    const Point along = nearest[1] - nearest[0];
    const Point across = (search_m * edge.metre / norm(along)) * Point{-along.y, along.x};
    const Point middle = nearestOnSegment(place, nearest[0], nearest[1]);
    transects.push_back({view.placeOf(middle - across), view.placeOf(middle + across)});
  }
  return transects;
}

}  // namespace coastmesh
