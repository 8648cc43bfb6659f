#include "apps/input/largest_group.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <numeric>

#include "gis/clean/geodesic_area.hpp"
#include "gis/coast/flood_plains.hpp"

namespace coastmesh {

namespace {

// The area of each group's polygons, whatever frames and regions are in it. Its domain has at most this area, unless
// parts of a polygon were cut off.
std::vector<double> polygonAreas(const JobInput& input, const ItemLoop& loop) {
  const std::vector<Feature>& features = input.coastline().features;
  std::vector<double> areas(input.groups());
  forEachByStretches(loop, areas.size(), [&](std::size_t g) {
    std::vector<std::size_t> own;
    std::ranges::copy_if(input.members(g), std::back_inserter(own), [&](std::size_t member) {
      return features[member].use == FeatureUse::Area || features[member].use == FeatureUse::Land;
    });
    areas[g] = geodesicArea(input.coastline(), own);
  });
  return areas;
}

bool isClipped(const JobInput& input, std::size_t group) {
  return std::ranges::any_of(input.members(group), [&](std::size_t member) {
    const Feature& feature = input.coastline().features[member];
    return feature.clipped || isFloodPlain(feature);
  });
}

}  // namespace

std::optional<LargestGroup> largestGroup(const JobInput& input, const ItemLoop& loop) {
  const std::vector<double> areas = polygonAreas(input, loop);
  std::vector<double> bounds = areas;
  for (std::size_t g = 0; g < bounds.size(); ++g)
    if (isClipped(input, g)) bounds[g] = std::numeric_limits<double>::infinity();
  std::vector<std::size_t> order(bounds.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::ranges::greater(), [&](std::size_t g) { return bounds[g]; });
  std::optional<LargestGroup> largest;
  double most = 0.0;
  for (const std::size_t g : order) {
    if (largest && bounds[g] <= most) break;
    std::optional<Domain> domain = input.domainIfAny(g, loop);
    if (!domain) continue;
    const double area = input.area(*domain, loop).value_or(0.0);
    if (largest && !(area > most)) continue;
    most = area;
    largest = {g, std::move(*domain), 1.0};
  }
  const double all = std::accumulate(areas.begin(), areas.end(), 0.0);
  if (largest && all > 0.0) largest->share = areas[largest->group] / all;
  return largest;
}

}  // namespace coastmesh
