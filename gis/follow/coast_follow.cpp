#include "gis/follow/coast_follow.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <utility>

#include "core/label_regions.hpp"
#include "core/metric.hpp"
#include "gis/follow/follow_notes.hpp"
#include "gis/follow/shore_chains.hpp"
#include "gis/follow/shore_coarsen.hpp"
#include "gis/follow/shore_ends.hpp"
#include "gis/follow/shore_graph.hpp"
#include "gis/follow/shore_joins.hpp"
#include "gis/follow/shore_mend.hpp"
#include "gis/follow/shore_shift.hpp"

namespace coastmesh {

namespace {

constexpr double kNoted = 0.005;  // of the area of the water: so near shores need not be moved for

}  // namespace

Domain followSizes(Domain&& domain, const SizeFunction& size, const FollowOptions& options, const Coastline& coastline,
                   CleanReport& report, const ShoreGuides& guides) {
  labelSegments(domain.pslg);
  const Projection& projection = domain.projection;
  const std::vector<Point> points = domain.pslg.points;
  ShoreGraph graph{std::move(domain.pslg), std::vector<VertexId>(points.size())};
  std::iota(graph.source.begin(), graph.source.end(), VertexId{0});
  const ShoreSizes sizes{size, projection};
  const ShoreEdit edit = [&](EditKind kind, const Point& place, RegionId water) {
    report.add(kind, projection.inverse(place), coastline.features[static_cast<std::size_t>(water)].fid);
  };
  sampleShores(graph, size, guides.tree());
  FollowNotes noted;
  WaterAreas by_the_user;
  graph = widenPassages(graph, sizes, guides.passages, edit, by_the_user, noted.widened, noted.dry);
  graph = closeBarriers(graph, sizes, guides, edit);
  JoinedShores joined = openJoined(std::move(graph), sizes, guides, options, edit);
  OpenedShores& opened = joined.opened;
  for (const auto& [kind, place, water] : opened.edits) edit(kind, place, water);
  noted.straits = std::move(opened.straits);
  noted.joined = std::move(joined.joined);
  for (std::size_t i = 0; i < opened.waters.size(); ++i) {
    noted.area += opened.waters[i].area;
    if (!opened.waters[i].kept) noted.cut_off.push_back({std::move(opened.waters[i]), std::move(joined.ways[i])});
  }
  noteFollowing(std::move(noted), guides, options, projection, report);

  ShoreChains chains = chainsOf(std::move(opened.graph), size);
  const auto reportAs = [&](EditKind kind, VertexId v) {
    if (chains.source[v] != kNone)
      report.add(kind, projection.inverse(points[chains.source[v]]),
                 coastline.features[static_cast<std::size_t>(chains.leaving[v].left)].fid);
  };
  // What the water gains where v goes to x, or straight on where x is none.
  const auto gain = [&](VertexId v, const Point* x) {
    const Point &a = chains.at[chains.prev[v]], &b = chains.at[chains.next[v]], &from = chains.at[v];
    const double scale = projection.scaleAt(from);
    const double twice = (x != nullptr ? cross(*x - a, b - a) : 0.0) - cross(from - a, b - a);
    opened.gained[chains.leaving[v].left] += 0.5 * twice / scale / scale;
  };
  const ShoreLoss gone = [&](VertexId v) {
    reportAs(EditKind::SimplifiedPoint, v);
    gain(v, nullptr);
  };
  const ShoreMove moved = [&](VertexId v, const Point& x) {
    reportAs(EditKind::MovedPoint, v);
    gain(v, &x);
  };
  mendEnds(chains, gone);
  coarsenShores(chains, gone);
  mendShores(chains, gone, moved);
  WaterAreas missing;
  for (const auto& [water, gained] : opened.gained)
    if (std::abs(gained) > kNoted * opened.areas[water]) missing[water] = -gained;
  if (!missing.empty()) shiftShores(chains, missing, projection, moved);
  graph = graphOf(std::move(chains));

  Domain followed;
  followed.projection = projection;
  followed.resolution = domain.resolution;
  followed.lines = std::move(domain.lines);
  for (VertexId v = 0; v < graph.source.size(); ++v) {
    const VertexId source = graph.source[v];
    followed.input_points.push_back(source != kNone ? domain.input_points[source]
                                                    : projection.inverse(graph.pslg.points[v]));
  }
  followed.pslg = std::move(graph.pslg);
  return followed;
}

}  // namespace coastmesh
