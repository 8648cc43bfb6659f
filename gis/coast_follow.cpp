#include "gis/coast_follow.hpp"

#include <algorithm>
#include <cstdio>
#include <functional>
#include <numeric>
#include <string>
#include <utility>

#include "core/label_regions.hpp"
#include "gis/shore_chains.hpp"
#include "gis/shore_coarsen.hpp"
#include "gis/shore_ends.hpp"
#include "gis/shore_graph.hpp"
#include "gis/shore_mend.hpp"
#include "gis/shore_opening.hpp"

namespace coastmesh {

namespace {

constexpr std::size_t kNamed = 3;  // cut-off waters

std::string noteOn(std::vector<CutOffWater>&& waters, const FollowOptions& options, const Projection& projection) {
  std::ranges::stable_sort(waters, std::ranges::greater{}, &CutOffWater::area);
  std::string note =
      "closing narrow water cut off " + std::to_string(waters.size()) +
      (options.keep == KeepWater::All ? " waters, which are meshed apart" : " waters, which are left out");
  for (std::size_t i = 0; i < std::min(kNamed, waters.size()); ++i) {
    const double scale = projection.scaleAt(waters[i].place);
    const Point place = projection.inverse(waters[i].place);
    char text[120];
    const double area = waters[i].area / scale / scale;
    std::snprintf(text, sizeof text,
                  projection.isIdentity() ? "%s %.3g at (%.6g, %.6g)" : "%s %.3g km² at (%.6g, %.6g)",
                  i == 0 ? ": the largest" : ",", projection.isIdentity() ? area : 1e-6 * area, place.x, place.y);
    note += text;
  }
  return note + "; a smaller --channel-min keeps what joins them, --keep-water decides what stays";
}

}  // namespace

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
  std::vector<CutOffWater> cut_off;
  graph = openWater(graph, size, options.channel_min, options.keep, edit, cut_off);
  if (!cut_off.empty()) report.notes.push_back(noteOn(std::move(cut_off), options, projection));

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
