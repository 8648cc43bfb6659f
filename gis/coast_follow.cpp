#include "gis/coast_follow.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/label_regions.hpp"
#include "gis/shore_chains.hpp"
#include "gis/shore_coarsen.hpp"
#include "gis/shore_ends.hpp"
#include "gis/shore_graph.hpp"
#include "gis/shore_mend.hpp"
#include "gis/shore_opening.hpp"

namespace coastmesh {

Domain followSizes(Domain&& domain, const SizeFunction& size, const FollowOptions& options, const Coastline& coastline,
                   CleanReport& report) {
  labelSegments(domain.pslg);
  const Projection& projection = domain.projection;
  const ShoreEdit edit = [&](EditKind kind, const Point& place, RegionId water) {
    report.add(kind, projection.inverse(place), coastline.features[static_cast<std::size_t>(water)].fid);
  };
  const std::vector<Point> points = domain.pslg.points;
  ShoreGraph graph{std::move(domain.pslg), std::vector<VertexId>(points.size())};
  std::iota(graph.source.begin(), graph.source.end(), VertexId{0});
  sampleShores(graph, size);
  graph = openLand(graph, size, options.land_min, edit);
  graph = openWater(graph, size, options.channel_min, edit);

  ShoreChains chains = chainsOf(std::move(graph), size);
  const auto tell = [&](EditKind kind) {
    return [&, kind](VertexId v, RegionId water) {
      if (chains.source[v] != kNone) edit(kind, points[chains.source[v]], water);
    };
  };
  mendEnds(chains, tell(EditKind::SimplifiedPoint));
  coarsenShores(chains, tell(EditKind::SimplifiedPoint));
  mendShores(chains, tell(EditKind::SimplifiedPoint), tell(EditKind::MovedPoint));
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
