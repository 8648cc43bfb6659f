#include "gis/follow/coast_follow.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <ranges>
#include <string>
#include <utility>

#include "core/metric.hpp"
#include "core/triangulate/label_regions.hpp"
#include "gis/coast/segment_tags.hpp"
#include "gis/follow/domain_shores.hpp"
#include "gis/follow/follow_notes.hpp"
#include "gis/follow/passage_sizes.hpp"
#include "gis/follow/shore_joins.hpp"
#include "gis/follow/shore_settle.hpp"
#include "gis/follow/water_lines.hpp"
#include "gis/shore/asked_points.hpp"
#include "gis/shore/shore_chains.hpp"
#include "gis/shore/shore_coarsen.hpp"
#include "gis/shore/shore_ends.hpp"
#include "gis/shore/shore_graph.hpp"
#include "gis/shore/shore_meets.hpp"
#include "gis/shore/shore_mend.hpp"
#include "gis/shore/shore_shift.hpp"
#include "gis/shore/shore_thin.hpp"
#include "gis/shore/water_width.hpp"

namespace coastmesh {

namespace {

constexpr double kNoted = 0.005;       // of the water's area: smaller differences do not move shores
constexpr double kMuchShorter = 0.25;  // of the size: following leaves hardly any segment shorter than half of it

// Adds the area that the water gains if v moves to x, or is removed if x is null.
void addGain(const ShoreChains& chains, VertexId v, const Point* x, const ScaleTable& scales, WaterAreas& gained) {
  const Point &a = chains.at[chains.prev[v]], &b = chains.at[chains.next[v]], &from = chains.at[v];
  const double scale = scales.at(from);
  const double twice = (x != nullptr ? cross(*x - a, b - a) : 0.0) - cross(from - a, b - a);
  gained[chains.leaving[v].left] += 0.5 * twice / scale / scale;
}

// Calls `thinShores`. `before`: sizes of an earlier thinning, or null.
void thin(ShoreChains& chains, const ShoreSizes& sizes, const BoxTree& lines, const FollowOptions& options,
          const SizeFunction* before, const EditLog& log, WaterAreas& gained, const ItemLoop& loop) {
  limitToSmallWaters(chains);
  const auto dropped = [&](VertexId v, double area) {
    const double scale = sizes.scale.at(chains.at[v]);
    log.add(EditKind::SmallIsland, chains, v);
    gained[chains.leaving[v].left] += area / scale / scale;
  };
  const ShoreLoss gone = [&](VertexId v) {
    log.add(EditKind::SimplifiedPoint, chains, v);
    addGain(chains, v, nullptr, sizes.scale, gained);
  };
  // Does nothing unless some sizes are clearly larger than before.
  const auto isMore = [&](VertexId v) { return chains.size[v] >= kMuchMore * before->at(chains.at[v]); };
  const auto vertices = std::views::iota(VertexId{0}, static_cast<VertexId>(chains.at.size()));
  if (before != nullptr && std::ranges::none_of(vertices, isMore)) return;
  thinShores(chains, {lines, options.channel_min < 1.0, dropped, before}, gone, loop);
}

// Calls `mendEnds`, which lets ends go that it removes: not those that the user requested.
void mendEndsButAsked(ShoreChains& chains, const std::vector<VertexId>& asked, const ShoreLoss& gone) {
  mendEnds(chains, gone);
  keepAsked(chains, asked);
}

std::vector<VertexId> together(std::vector<VertexId> these, const std::vector<VertexId>& others) {
  these.insert(these.end(), others.begin(), others.end());
  return these;
}

// A constant length on the ground, as lengths in the plane.
class SameOnGround final : public SizeFunction {
 public:
  SameOnGround(double length_m, const ScaleTable& scales) : length_m_(length_m), scales_(scales) {}

  double at(const Point& x) const override { return length_m_ * scales_.at(x); }
  double least() const override { return 0.0; }
  double most() const override { return std::numeric_limits<double>::infinity(); }

 private:
  double length_m_;
  const ScaleTable& scales_;
};

// What the steps of following have in common.
struct FollowTask {
  const FollowOptions& options;
  const ShoreGuides& guides;
  const EditLog& log;
  const ScaleTable& scales;
  const AskedPoints& asked;
  const EvenSizes* even;  // sizes that the distance from the shore determines; null if it does not
  const ItemLoop& loop;
};

// Thins, samples and triangulates the domain's shores. Lines in the water are set aside, as its width does not depend
// on them; `lost` gets parts that cannot be followed, which must not keep land.
ShoreStart triangulated(Domain& domain, const SizeFunction& size, FollowStart&& known, const FollowTask& task,
                        WaterLines& in_water, LostLines& lost) {
  const ShoreSizes sizes{size, task.scales};
  const SameOnGround thinned(known.thinned_m, task.scales);
  ShoreStart start;
  start.gained = std::move(known.gained);
  ShoreChains chains = chainsOf(takeGraph(domain), size, task.loop, task.even);
  keepAsked(chains, task.asked.sources());
  thin(chains, sizes, task.guides.tree(), task.options, known.thinned_m > 0.0 ? &thinned : nullptr, task.log,
       start.gained, task.loop);
  ShoreGraph graph = graphOf(std::move(chains));
  returnLines(graph, takeLines(graph, task.asked.sources()), sizes, task.options.channel_min, lost);
  in_water = takeLines(graph, task.asked.sources());
  const std::vector<VertexId> ends_of_lines = bridgeLand(graph, in_water, size);
  sampleShores(graph, size, task.guides.tree(), task.loop, task.even);
  start.triangles = triangulateShores(std::move(graph), size, task.loop, task.even);
  for (const VertexId v : ends_of_lines) start.triangles.use[v] |= kAtLine;
  return start;
}

// Opens passages and closes barriers that the user gave.
void applyGuides(ShoreTriangles& triangles, const PassageSizes& size, const FollowTask& task, const ShoreEdit& edit,
                 FollowNotes& noted) {
  if (task.guides.passages.empty() && task.guides.barriers.empty()) return;
  const ShoreSizes sizes{size, task.scales};
  WaterAreas by_the_user;
  size.measure(triangles);
  const SmallWaters small =
      smallWaters(triangles, sizes, {}, task.options.leastOfSmall(), connectedRegions(triangles, task.loop), task.loop);
  widenPassages(triangles, sizes, task.guides.passages, small, edit, by_the_user, noted.passages);
  closeBarriers(triangles, sizes, task.guides, edit, noted.open_barriers);
}

// Takes from the opened shores what is to be noted of their waters.
void noteOpened(JoinedShores& joined, KeepWater keep, FollowNotes& noted) {
  OpenedShores& opened = joined.opened;
  noted.straits = std::move(joined.straits);
  noted.spits = std::move(opened.spits);
  noted.joined = std::move(joined.joined);
  const std::vector<bool> is_main = areMain(opened.waters);
  for (std::size_t i = 0; i < opened.waters.size(); ++i) {
    WaterPart& water = opened.waters[i];
    noted.area += water.area;
    if (water.small && (water.kept || keep == KeepWater::All))
      noted.too_small.push_back({water.area, water.inside.front()});
    if (is_main[i]) continue;
    (water.kept ? noted.apart : noted.cut_off).push_back({std::move(water), std::move(joined.ways[i])});
  }
}

// Gives opened shores segments about as long as the sizes, repairs them, and lets waters that lost or gained much area
// take or give it back.
ShoreGraph coarsened(ShoreGraph&& graph, const Domain& domain, const SizeFunction& size, OpenedShores& opened,
                     const FollowTask& task, CleanReport& report) {
  ShoreChains chains = chainsOf(std::move(graph), size, task.loop, task.even);
  chains.frame = ShoreFrame(domain.frame);
  keepAsked(chains, task.asked.sources());
  dropSamples(chains);
  limitToNarrowWaters(chains);
  const ShoreLoss gone = [&](VertexId v) {
    task.log.add(EditKind::SimplifiedPoint, chains, v);
    addGain(chains, v, nullptr, task.scales, opened.gained);
  };
  const ShoreMove moved = [&](VertexId v, const Point& x) {
    task.log.add(EditKind::MovedPoint, chains, v);
    addGain(chains, v, &x, task.scales, opened.gained);
  };
  mendEndsButAsked(chains, task.asked.sources(), gone);
  coarsenShores(chains, gone);
  meetPoints(chains, [&](VertexId v, VertexId w) {
    const Point& x = chains.at[w];
    addGain(chains, v, &x, task.scales, opened.gained);
    task.log.add(EditKind::MovedPoint, x, chains.leaving[v].left);
    report.waters.met.add(metPoint(x, distance(chains.at[v], x) / task.scales.at(x), domain.projection));
  });
  mendShores(chains, gone, moved, task.loop);
  WaterAreas missing;
  for (const auto& [water, gained] : opened.gained)
    if (std::abs(gained) > kNoted * opened.areas[water]) missing[water] = -gained;
  if (!missing.empty()) shiftShores(chains, missing, task.scales, moved);
  return graphOf(std::move(chains));
}

}  // namespace

Domain thinToLeast(Domain&& domain, double least_m, const FollowOptions& options, const Coastline& coastline,
                   const ShoreGuides& guides, CleanReport& report, FollowStart& start, const ItemLoop& loop) {
  constexpr double kMuchFiner = 0.45;  // mean length of segments in sizes; above it, hardly any would be removed
  Box box;
  for (const Point& p : domain.pslg.points) box.add(p);
  const ScaleTable scales(domain.projection, box);
  const SameOnGround least(least_m, scales);
  double length = 0.0;
  for (const Segment& s : domain.pslg.segments) length += distance(domain.pslg.points[s.a], domain.pslg.points[s.b]);
  const double elements = length / least.at(midpoint(Point{box.xmin, box.ymin}, Point{box.xmax, box.ymax}));
  if (!(elements < kMuchFiner * static_cast<double>(domain.pslg.segments.size()))) return std::move(domain);
  labelSegments(domain.pslg);
  start.thinned_m = least_m;
  const EditLog log{domain, coastline, report};
  ShoreChains chains = chainsOf(takeGraph(domain), least, loop);
  keepAsked(chains, domain.asked);
  thin(chains, {least, scales}, guides.tree(), options, nullptr, log, start.gained, loop);
  return domainOf(graphOf(std::move(chains)), std::move(domain));
}

Domain followSizes(Domain&& domain, const SizeFunction& wanted, const FollowOptions& options,
                   const Coastline& coastline, CleanReport& report, const ShoreGuides& guides, const ItemLoop& loop,
                   FollowStart known) {
  labelSegments(domain.pslg);
  Box box;
  for (const Point& p : domain.pslg.points) box.add(p);
  const ScaleTable scales(domain.projection, box);
  const SizesInPlane in_plane(wanted, domain);
  const EditLog log{domain, coastline, report};
  const ShoreEdit edit = [&](EditKind kind, const Point& place, RegionId water) { log.add(kind, place, water); };
  const SameOnGround on_shore(known.shore_m, scales);
  const EvenSizes growing{known.rate, on_shore};
  const AskedPoints asked(domain.asked, domain.pslg.points);
  const FollowTask task{options, guides, log, scales, asked, std::isnan(known.rate) ? nullptr : &growing, loop};
  WaterLines in_water;
  LostLines lost;
  std::optional<DataShores> data;
  if (known.data == nullptr) known.data = &data.emplace(domain.pslg);
  const DataShores& shores = *known.data;
  ShoreStart start = triangulated(domain, in_plane.get(), std::move(known), task, in_water, lost);
  const PassageSizes size(in_plane.get(), guides.passages, start.triangles);
  const ShoreSizes sizes{size, scales};
  FollowNotes noted;
  applyGuides(start.triangles, size, task, edit, noted);
  JoinedShores joined = openJoined(std::move(start), shores, sizes, guides, options, loop);
  for (const auto& [kind, place, water] : joined.opened.edits) edit(kind, place, water);
  noteOpened(joined, options.keep, noted);
  noteFollowing(std::move(noted), guides, options, domain.projection, report);

  ShoreGraph graph = settledGraph(std::move(joined.opened.after), size, loop);
  // Points on the shore of land that was removed are in the water now.
  addLoose(in_water, asked.missingFrom(together(graph.source, in_water.source)));
  returnLines(graph, std::move(in_water), sizes, options.channel_min, lost);
  ShoreGraph followed = coarsened(std::move(graph), domain, size, joined.opened, task, report);
  addLost(lost, asked.missingFrom(followed.source));
  noteLostLines(lost, domain, report);
  return domainOf(std::move(followed), std::move(domain));
}

SizeGrowth growthOf(const Pslg& pslg, const SizeFunction& before, const SizeFunction& after, const ItemLoop& loop) {
  const std::vector<double> was = sizesAt(pslg.points, {}, before, nullptr, loop),
                            is = sizesAt(pslg.points, {}, after, nullptr, loop);
  std::vector<bool> on_shore(pslg.points.size(), false);
  for (const Segment& s : pslg.segments)
    if (isBoundary(s) && !isOpenTag(s.tag)) on_shore[s.a] = on_shore[s.b] = true;
  SizeGrowth growth;
  for (VertexId v = 0; v < pslg.points.size(); ++v) {
    double& most = on_shore[v] ? growth.shore : growth.elsewhere;
    most = std::max(most, is[v] / was[v]);
  }
  return growth;
}

Domain coarsenFurther(Domain&& domain, const SizeFunction& size, const Coastline& coastline, CleanReport& report,
                      const ItemLoop& loop) {
  const SizesInPlane in_plane(size, domain);
  ShoreChains chains = chainsOf(takeGraph(domain), in_plane.get(), loop);
  chains.frame = ShoreFrame(domain.frame);
  keepAsked(chains, domain.asked);
  limitToNarrowWaters(chains);
  const EditLog log{domain, coastline, report};
  const ShoreLoss gone = [&](VertexId v) { log.add(EditKind::SimplifiedPoint, chains, v); };
  const ShoreMove moved = [&](VertexId v, const Point&) { log.add(EditKind::MovedPoint, chains, v); };
  mendEndsButAsked(chains, domain.asked, gone);
  coarsenShores(chains, gone);
  mendShores(chains, gone, moved, loop);
  return domainOf(graphOf(std::move(chains)), std::move(domain));
}

void warnOfShortSegments(const Domain& followed, const SizeFunction& size, CleanReport& report, const ItemLoop& loop) {
  const SizesInPlane in_plane(size, followed);
  Domain copy = followed;
  ShoreChains chains = chainsOf(takeGraph(copy), in_plane.get(), loop);
  limitToNarrowWaters(chains);
  std::vector<char> is_given(chains.at.size(), 0);
  for (const VertexId v : followed.asked) is_given[v] = 1;
  for (const Segment& s : chains.lines) is_given[s.a] = is_given[s.b] = 1;
  ShortSegments found;
  double shortest = kMuchShorter;
  for (VertexId v = 0; v < chains.at.size(); ++v) {
    const VertexId q = chains.next[v];
    if (q == kNone || is_given[v] || is_given[q]) continue;
    const double wanted = std::min(chains.size[v], chains.size[q]), length = distance(chains.at[v], chains.at[q]);
    if (!(length < kMuchShorter * wanted)) continue;
    ++found.count;
    if (!(length < shortest * wanted)) continue;
    shortest = length / wanted;
    found.place = midpoint(chains.at[v], chains.at[q]);
    const double scale = followed.projection.scaleAt(found.place);
    found.length_m = length / scale;
    found.size_m = wanted / scale;
  }
  if (found.count > 0) report.warnings.push_back(warningOf(found, followed.projection));
}

}  // namespace coastmesh
