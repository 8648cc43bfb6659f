#include "gis/coast_follow.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <numeric>
#include <string>
#include <tuple>
#include <utility>

#include "core/label_regions.hpp"
#include "core/metric.hpp"
#include "gis/shore_chains.hpp"
#include "gis/shore_coarsen.hpp"
#include "gis/shore_ends.hpp"
#include "gis/shore_graph.hpp"
#include "gis/shore_mend.hpp"
#include "gis/shore_opening.hpp"
#include "gis/shore_shift.hpp"

namespace coastmesh {

namespace {

constexpr std::size_t kNamed = 3;  // cut-off waters
// Of the area of the water.
constexpr double kClose = 0.01;   // so near the order of land and water need not be changed for
constexpr double kNoted = 0.005;  // so near shores need not be moved for
// Of the narrowest land that stays.
constexpr double kStep = 0.1, kLeastFirst = 0.45;
constexpr int kHalvings = 3;

struct Opened {
  OpenedWater water;
  WaterAreas gained;
  std::vector<std::tuple<EditKind, Point, RegionId>> edits;
  double error = std::numeric_limits<double>::infinity();  // share of the water that there is too much
};

// Land narrower than `first` times the narrowest that stays goes, then narrow water, then the rest of the land, and again water.
Opened openBoth(const ShoreGraph& graph, const ShoreSizes& sizes, const FollowOptions& options, double first) {
  Opened opened;
  const ShoreEdit edit = [&](EditKind kind, const Point& place, RegionId water) {
    opened.edits.emplace_back(kind, place, water);
  };
  ShoreGraph land = openLand(graph, sizes, first * options.land_min, edit, opened.gained);
  if (first < 1.0) {
    land = openWater(land, sizes, options.channel_min, KeepWater::All, edit, opened.gained).graph;
    land = openLand(land, sizes, options.land_min, edit, opened.gained);
  }
  opened.water = openWater(land, sizes, options.channel_min, options.keep, edit, opened.gained);
  double gained = 0.0, area = 0.0;
  for (const auto& [water, more] : opened.gained) gained += more;
  for (const auto& [water, there] : opened.water.areas) area += there;
  opened.error = gained / area;
  return opened;
}

// Where both land and water are narrow, what goes first leaves room for the other: the less land goes before water is closed, the less
// water there is in the end. As much goes first as brings the water's area near to what it was.
Opened openAlike(const ShoreGraph& graph, const ShoreSizes& sizes, const FollowOptions& options) {
  double high = 1.0, low = 1.0;
  Opened best = openBoth(graph, sizes, options, high);
  const auto attempt = [&](double first) {
    Opened opened = openBoth(graph, sizes, options, first);
    (opened.error > 0.0 ? high : low) = first;
    if (std::abs(opened.error) < std::abs(best.error)) best = std::move(opened);
  };
  if (options.land_min == 0.0 || best.error < kClose) return best;
  while (low == 1.0 && high > kLeastFirst && std::abs(best.error) > kClose) attempt(high - kStep);
  for (int i = 0; i < kHalvings && low < 1.0 && std::abs(best.error) > kClose; ++i) attempt(0.5 * (low + high));
  return best;
}

std::string noteOn(std::vector<CutOffWater>&& waters, const FollowOptions& options, const Projection& projection) {
  std::ranges::stable_sort(waters, std::ranges::greater{}, &CutOffWater::area);
  std::string note =
      "closing narrow water cut off " + std::to_string(waters.size()) +
      (options.keep == KeepWater::All ? " waters, which are meshed apart" : " waters, which are left out");
  for (std::size_t i = 0; i < std::min(kNamed, waters.size()); ++i) {
    const Point place = projection.inverse(waters[i].place);
    char text[120];
    const double area = waters[i].area;
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
  const std::vector<Point> points = domain.pslg.points;
  ShoreGraph graph{std::move(domain.pslg), std::vector<VertexId>(points.size())};
  std::iota(graph.source.begin(), graph.source.end(), VertexId{0});
  sampleShores(graph, size);
  Opened opened = openAlike(graph, {size, projection}, options);
  for (const auto& [kind, place, water] : opened.edits)
    report.add(kind, projection.inverse(place), coastline.features[static_cast<std::size_t>(water)].fid);
  if (!opened.water.cut_off.empty())
    report.notes.push_back(noteOn(std::move(opened.water.cut_off), options, projection));

  ShoreChains chains = chainsOf(std::move(opened.water.graph), size);
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
    if (std::abs(gained) > kNoted * opened.water.areas[water]) missing[water] = -gained;
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
