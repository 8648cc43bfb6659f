#include "gis/follow/least_edges.hpp"

#include <cmath>
#include <utility>

#include "core/metric.hpp"
#include "core/triangulate/label_regions.hpp"
#include "gis/follow/domain_shores.hpp"
#include "gis/follow/shore_sizes.hpp"
#include "gis/projection/scale_table.hpp"
#include "gis/shore/shore_chains.hpp"
#include "gis/shore/shore_mend.hpp"
#include "gis/shore/shore_shift.hpp"
#include "gis/shore/water_width.hpp"

namespace coastmesh {

namespace {

constexpr double kNoted = 0.001;  // of the water's area: smaller differences do not move shores

// The area of each water, with the scale at the middle of each segment: accurate for differences if only shores have
// moved.
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
  const SizesInPlane in_plane(size, domain);
  ShoreChains chains = chainsOf(takeGraph(domain), in_plane.get(), loop);
  chains.frame = ShoreFrame(domain.frame);
  keepAsked(chains, domain.asked);
  for (const Point& p : chains.at) chains.least.push_back(wishes.least_m * scales.at(p));
  limitToNarrowWaters(chains);
  chains.no_square_ends = wishes.no_square_ends;
  const EditLog log{domain, coastline, report};
  WaterAreas areas = areasOf(chains, scales), missing;
  const ShoreLoss gone = [&](VertexId v) { log.add(EditKind::SimplifiedPoint, chains, v); };
  const ShoreMove moved = [&](VertexId v, const Point&) { log.add(EditKind::MovedPoint, chains, v); };
  mendShores(chains, gone, moved, loop);
  for (const auto& [water, area] : areasOf(chains, scales))
    if (std::abs(area - areas[water]) > kNoted * areas[water]) missing[water] = areas[water] - area;
  if (!missing.empty()) shiftShores(chains, missing, scales, moved);
  return domainOf(graphOf(std::move(chains)), std::move(domain));
}

}  // namespace coastmesh
