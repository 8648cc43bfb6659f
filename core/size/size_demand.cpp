#include "core/size/size_demand.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/metric.hpp"
#include "core/size/on_surface.hpp"
#include "core/size/size_grading.hpp"

namespace coastmesh {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Vertices per unit area of equilateral triangles with edges of length 1.
const double kVerticesPerArea = 2.0 / std::sqrt(3.0);

}  // namespace

CellDemand demandIn(const SizeBox& box, const SizeRange& range, const SizeTreeTask& task) {
  const double share = task.source.share(box);
  const double area =
      task.surface().isCurved() ? share * areaOn(task.surface(), box) : share * 4.0 * box.half * box.half;
  if (!(area > 0.0) || range.low == kInfinity) return {};
  // Graded lengths grow no faster from the smallest one; the mean of 1 / h² of a linearly growing length is 1 over the
  // product of its ends.
  const double side = longestSide(task.surface(), box);
  const double high = std::min(range.high, range.low + task.options.gradation * std::sqrt(2.0) * side);
  const double low = range.low > 0.0 ? range.low : high;
  const double likely = kVerticesPerArea * area / low / high;
  const double least = kVerticesPerArea * area / range.high / range.high;
  const double centre = range.at_centre;
  const double central = std::isfinite(centre) && centre > 0.0 ? kVerticesPerArea * area / centre / centre : least;
  return {least, likely, central, low};
}

void DemandLimit::see(const DemandSum& demand) {
  constexpr std::size_t kLevelsAlike = 3;
  constexpr double kAlike = 0.8, kFarTooMuch = 1.5;
  const double likely = demand.likely;
  likely_.push_back(likely);
  const bool is_far_too_much = likely_.size() > kLevelsAlike && likely > kFarTooMuch * most_;
  const bool stays = is_far_too_much && std::all_of(likely_.end() - kLevelsAlike - 1, likely_.end() - 1,
                                                    [&](double before) { return likely >= kAlike * before; });
  is_exceeded_ |= stays || demand.least > most_;

  constexpr double kError = 1.1;  // of many cells together
  levels_beyond_ = demand.central > kError * most_ ? levels_beyond_ + 1 : 0;
}

bool DemandLimit::isExceededOnAverage() const {
  constexpr int kEnoughLevels = 3;
  return levels_beyond_ >= kEnoughLevels;
}

SizeDemand demandOfLeaves(const SizeCells& cells, const SizeVertices& vertices, const SizeLeaves& leaves,
                          const SizeTreeTask& task) {
  const Surface& surface = task.surface();
  const double unit = cells.unit;
  const auto gridPoint = [&](std::uint32_t v) { return Point{1.0 * vertices.places[v].x, 1.0 * vertices.places[v].y}; };
  // Area on the surface over area in the plane, in the middle of an edge.
  const auto areaScale = [&](std::uint32_t p, std::uint32_t q) {
    if (!surface.isCurved()) return 1.0;
    const double shrink = surface.shrinkAt(cells.origin + 0.5 * unit * (gridPoint(p) + gridPoint(q)));
    return shrink * shrink;
  };
  const auto atMiddle = [](double p, double q) { return 4.0 / (p + q) / (p + q); };
  const DemandSum all = sumOver(task.loop, leaves.count(), {}, [&](DemandSum& sum, std::size_t l) {
    if (!leaves.is_wanted[l]) return;
    const SizeBox box = cells.boxOf(cells.leaf_cells[l]);
    const double share = task.source.share(box);
    if (!(share > 0.0)) return;
    DemandSum here{0.0, 0.0, 0.0, 0.0, box, kInfinity};
    forEachTriangle(leaves.vertices[l], [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      const double x = vertices.sizes.size[a], y = vertices.sizes.size[b], z = vertices.sizes.size[c];
      const double area = 0.5 * unit * unit * std::abs(cross(gridPoint(b) - gridPoint(a), gridPoint(c) - gridPoint(a)));
      const double per_area =
          areaScale(a, b) * atMiddle(x, y) + areaScale(b, c) * atMiddle(y, z) + areaScale(c, a) * atMiddle(z, x);
      here.likely += kVerticesPerArea * share * area * per_area / 3.0;
      here.size = std::min({here.size, x, y, z});
    });
    here.most_here = here.likely;
    sum.add(here);
  });
  return {all.likely, all.most_in, all.size};
}

}  // namespace coastmesh
