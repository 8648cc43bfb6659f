#include "gis/follow/least_edges.hpp"

#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "core/label_regions.hpp"
#include "core/metric.hpp"
#include "core/size/plane_sizes.hpp"
#include "gis/follow/shore_sizes.hpp"
#include "gis/projection/scale_table.hpp"
#include "gis/shore/shore_chains.hpp"
#include "gis/shore/shore_mend.hpp"
#include "gis/shore/shore_shift.hpp"

namespace coastmesh {

namespace {

constexpr double kNoted = 0.001;  // of the area of the water: so near shores need not be moved for

// Of each water, with the scale at the middle of each segment: good for differences where only shores have moved.
WaterAreas areasOf(const ShoreChains& chains, const ScaleTable& scales) {
  WaterAreas areas;
  if (chains.at.empty()) return areas;
  const Point origin = chains.at.front();
  for (VertexId v = 0; v < chains.at.size(); ++v) {
    if (!chains.alive[v] || chains.next[v] == kNone) continue;
    const Point &a = chains.at[v], &b = chains.at[chains.next[v]];
    const double scale = scales.at(midpoint(a, b));
    areas[chains.leaving[v].left] += 0.5 * cross(a - origin, b - origin) / scale / scale;
  }
  return areas;
}

}  // namespace

Domain lengthenShores(Domain&& domain, const EdgeWishes& wishes, const SizeFunction& size, const Coastline& coastline,
                      CleanReport& report, const ItemLoop& loop) {
  labelSegments(domain.pslg);
  Box box;
  for (const Point& p : domain.pslg.points) box.add(p);
  const ScaleTable scales(domain.projection, box);
  const Surface surface = domain.projection.surface();
  std::optional<PlaneSizes> in_plane;
  if (surface.isCurved()) in_plane.emplace(size, surface, Point{box.xmin, box.ymin}, Point{box.xmax, box.ymax});
  ShoreGraph graph{std::move(domain.pslg), std::vector<VertexId>(domain.input_points.size())};
  std::iota(graph.source.begin(), graph.source.end(), VertexId{0});
  ShoreChains chains = chainsOf(std::move(graph), in_plane ? *in_plane : size, loop);
  for (const Point& p : chains.at) chains.least.push_back(wishes.least_m * scales.at(p));
  chains.no_square_ends = wishes.no_square_ends;
  const auto log = [&](EditKind kind, VertexId v) {
    if (chains.source[v] == kNone) return;
    report.add(kind, domain.input_points[chains.source[v]], coastline,
               static_cast<std::size_t>(chains.leaving[v].left));
  };
  WaterAreas areas = areasOf(chains, scales), missing;
  const ShoreLoss gone = [&](VertexId v) { log(EditKind::SimplifiedPoint, v); };
  const ShoreMove moved = [&](VertexId v, const Point&) { log(EditKind::MovedPoint, v); };
  mendShores(chains, gone, moved, loop);
  for (const auto& [water, area] : areasOf(chains, scales))
    if (std::abs(area - areas[water]) > kNoted * areas[water]) missing[water] = areas[water] - area;
  if (!missing.empty()) shiftShores(chains, missing, scales, moved);
  graph = graphOf(std::move(chains));
  std::vector<Point> input_points;
  for (VertexId v = 0; v < graph.source.size(); ++v)
    input_points.push_back(graph.source[v] != kNone ? domain.input_points[graph.source[v]]
                                                    : domain.projection.inverse(graph.pslg.points[v]));
  domain.input_points = std::move(input_points);
  domain.pslg = std::move(graph.pslg);
  return std::move(domain);
}

}  // namespace coastmesh
