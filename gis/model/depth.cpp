#include "gis/model/depth.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <numeric>
#include <optional>

#include "gis/for_count.hpp"
#include "gis/model/fill_depths.hpp"
#include "gis/model/impossible_depths.hpp"
#include "gis/places.hpp"
#include "gis/rounded_depth.hpp"
#include "gis/sample/raster_values.hpp"

namespace coastmesh {
namespace {

// Share of all nodes, or of the area: more without a value is not just the edge of a raster.
constexpr double kMuchWithout = 0.05;

// The share of the grid's area at nodes without a value: a third of each triangle at each of them.
double shareWithout(const Grid& grid) {
  double without = 0.0, all = 0.0;
  for (const auto& corners : grid.triangles) {
    const Point &a = grid.nodes[corners[0]], &b = grid.nodes[corners[1]], &c = grid.nodes[corners[2]];
    Point ab{b.x - a.x, b.y - a.y}, ac{c.x - a.x, c.y - a.y};
    if (grid.crs.geographic) {
      const double narrow = std::cos((a.y + b.y + c.y) / 3.0 * std::numbers::pi / 180.0);
      for (Point* side : {&ab, &ac}) side->x = std::remainder(side->x, 360.0) * narrow;
    }
    const double area = std::abs(ab.x * ac.y - ab.y * ac.x);
    all += area;
    for (const std::uint32_t corner : corners) without += std::isnan(grid.z[corner]) ? area / 3.0 : 0.0;
  }
  return all > 0.0 ? without / all : 0.0;
}

// Replaces unknown z by those of `before`, which has one for each node or is empty. Returns the number of replaced
// ones.
std::size_t keepFrom(const std::vector<double>& before, std::vector<double>& z) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (!std::isnan(z[i]) || std::isnan(before[i])) continue;
    z[i] = before[i];
    ++kept;
  }
  return kept;
}

// A warning about nodes for which no raster has a value; empty if they are few and lie in little of the mesh.
std::string gapWarning(const Grid& grid, const DepthOptions& options) {
  const auto isUnknown = [](double z) { return std::isnan(z); };
  const auto count = static_cast<std::size_t>(std::ranges::count_if(grid.z, isUnknown));
  if (count == 0) return {};
  const double of_nodes = static_cast<double>(count) / static_cast<double>(grid.nodes.size());
  const double of_area = shareWithout(grid);
  if (std::max(of_nodes, of_area) <= kMuchWithout) return {};
  const Point& first = grid.nodes[static_cast<std::size_t>(std::ranges::find_if(grid.z, isUnknown) - grid.z.begin())];
  char text[120];
  std::snprintf(text, sizeof text, "no raster has a value for %zu of %zu nodes (%.0f %%, and %.0f %% of the area)",
                count, grid.nodes.size(), 100.0 * of_nodes, 100.0 * of_area);
  return text + (", the first at (" + roughPlaceInWords(first)) + "): " +
         (options.fill == DepthFill::None ? "they stay without a depth"
                                          : "their depths are made from other nodes, however far") +
         "; give another --bathymetry that covers them";
}

// A warning about numbers that mean no value in a raster that does not declare them; empty if there are none.
std::string impossibleWarning(const Grid& grid, const DepthOptions& options) {
  if (grid.crs.isPlane()) return {};
  const auto valueOf = [&options](double z) {
    const double raised = z + options.water_level_m;
    return options.positive_down ? 0.0 - raised : raised;
  };
  const auto remedy = [](double value) {
    char text[120];
    std::snprintf(text, sizeof text, "gdal_translate -a_nodata %.10g", value);
    return ": where a raster has such a value for places without one, it has to say so (" + std::string(text) +
           "); nodes near to one lie between it and depths";
  };
  if (const std::optional<ImpossibleDepths> found = impossibleDepths(grid))
    return textOf(*found, grid) + remedy(valueOf(grid.z[found->worst]));
  // The usual value for places without one: as deep as a trench, but hardly ever measured to the millimetre.
  constexpr double kUsual = -9999.0, kRounding = 1e-6;
  const auto isUsual = [&](double z) { return std::abs(valueOf(z) - kUsual) < kRounding; };
  const auto first = std::ranges::find_if(grid.z, isUsual);
  if (first == grid.z.end()) return {};
  const auto count = static_cast<std::size_t>(std::ranges::count_if(grid.z, isUsual));
  return std::to_string(count) + " of " + std::to_string(grid.z.size()) + " nodes" + forCount(count, " has", " have") +
         " the value -9999, which often means none, the first at (" +
         roughPlaceInWords(grid.nodes[static_cast<std::size_t>(first - grid.z.begin())]) + ")" + remedy(kUsual);
}

// A warning about waters in which no raster has any value.
std::string apartWarning(const std::vector<std::uint32_t>& nodes, const Grid& grid) {
  return "no raster has a value in the waters of " + std::to_string(nodes.size()) +
         forCount(nodes.size(), " node", " nodes") + ", such as at (" + roughPlaceInWords(grid.nodes[nodes.front()]) +
         "): each got the depth of the nearest node of another water; a second --bathymetry may have them, and "
         "--keep-water leaves waters out";
}

// The number of nodes above the water that were not before. `before` may be empty.
std::size_t newlyDry(const std::vector<double>& before, const std::vector<double>& z) {
  std::size_t dry = 0;
  for (std::size_t i = 0; i < z.size(); ++i) dry += z[i] > 0.0 && (i >= before.size() || !(before[i] > 0.0));
  return dry;
}

// A warning that most nodes lie above the water, with possible reasons. `z` is that of all nodes.
std::string dryWarning(std::vector<double> z, std::size_t dry, const DepthOptions& options) {
  std::string text = std::to_string(dry) + " of " + std::to_string(z.size()) + " nodes lie above the water";
  const std::string by_sign = options.positive_down ? "do the rasters hold elevations, positive up? See --depth-sign"
                                                    : "do the rasters hold depths, positive down? See --depth-sign";
  std::erase_if(z, [](double height) { return std::isnan(height); });
  std::ranges::sort(z);
  // Without the extreme two percent at each end, which may be outliers.
  const double lowest = z[z.size() / 50], highest = z[z.size() - 1 - z.size() / 50];
  if (!(lowest > highest - lowest)) return text + "; " + by_sign;
  char heights[120];
  std::snprintf(heights, sizeof heights, ", nearly all of them between %.4g and %.4g m above it", lowest, highest);
  return text + heights +
         ": a lake's surface may be that high above the rasters' zero; give it with --water-level. Or " + by_sign;
}

void takeCounts(const RasterCounts& counts, DepthReport& report) {
  report.nodes_of_file = counts.nodes_of_file;
  report.averaged = counts.averaged;
  report.partial = counts.partial;
  report.notes = counts.notes;
  report.warnings = counts.warnings;
}

// Lowers nodes to the minimum depth, but none that `landOf` flags; those above the water only if not `mayBeLand(node)`.
// Returns how many.
template <typename MayBeLand>
std::size_t lowerWhere(Grid& grid, const DepthOptions& options, const MayBeLand& mayBeLand) {
  if (!std::isfinite(options.min_depth_m)) return 0;
  const std::vector<std::uint8_t> land = options.landOf ? options.landOf(grid) : std::vector<std::uint8_t>();
  std::size_t lowered = 0;
  for (std::size_t i = 0; i < grid.z.size(); ++i) {
    double& z = grid.z[i];
    if (!(z > 0.0 - options.min_depth_m) || (z >= 0.0 && mayBeLand(i)) || (!land.empty() && land[i] != 0)) continue;
    z = 0.0 - options.min_depth_m;
    ++lowered;
  }
  return lowered;
}

void measure(const Grid& grid, DepthReport& report) {
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  for (const double z : grid.z) {
    if (std::isnan(z)) {
      ++report.unknown;
      continue;
    }
    report.above_water += z > 0.0;
    least = std::min(least, 0.0 - z);
    greatest = std::max(greatest, 0.0 - z);
  }
  if (least <= greatest) {
    report.least_m = least;
    report.greatest_m = greatest;
  }
}

}  // namespace

bool hasDepths(const Grid& grid) {
  return std::ranges::any_of(grid.z, [](double z) { return !std::isnan(z) && z != 0.0; });
}

DepthReport setDepths(Grid& grid, const DepthOptions& options, const RunControl& control, const ItemLoop& loop) {
  DepthReport report;
  if (options.files.empty()) return report;
  const std::vector<double> before = options.keep_known ? std::move(grid.z) : std::vector<double>();
  RasterValues search(grid, {options.method == DepthMethod::Average, false, BandValues::Lengths, options.readers},
                      loop);
  for (const std::string& file : options.files) search.take({file}, control);
  grid.z = search.finish();
  takeCounts(search.counts(), report);
  for (double& z : grid.z) z = roundedDepth((options.positive_down ? 0.0 - z : z) - options.water_level_m);
  report.kept = keepFrom(before, grid.z);
  const std::size_t known = std::accumulate(report.nodes_of_file.begin(), report.nodes_of_file.end(), std::size_t{0});
  if (known == 0) {
    report.warnings.emplace_back("no raster has a value anywhere in the mesh; is its CRS right?");
  } else if (std::string warning = gapWarning(grid, options); !warning.empty()) {
    report.warnings.push_back(std::move(warning));
  }
  if (report.kept > 0)
    report.warnings.push_back("no raster has a value for " + std::to_string(report.kept) + " of " +
                              std::to_string(grid.nodes.size()) + " nodes, which keep the depths of the mesh");
  if (std::string warning = impossibleWarning(grid, options); !warning.empty())
    report.warnings.push_back(std::move(warning));
  if (options.fill == DepthFill::Neighbours) report.filled = fillFromNeighbours(grid, loop);
  if (options.fill == DepthFill::Nearest) report.filled = fillFromNearest(grid, loop);
  if (options.fill != DepthFill::None && known > 0) {
    const std::vector<std::uint32_t> apart = fillWatersApart(grid);
    report.filled += apart.size();
    if (!apart.empty()) report.warnings.push_back(apartWarning(apart, grid));
  }
  const auto dry = static_cast<std::size_t>(std::ranges::count_if(grid.z, [](double z) { return z > 0.0; }));
  if (2 * newlyDry(before, grid.z) > grid.nodes.size() && known > 0 && !options.has_land)
    report.warnings.push_back(dryWarning(grid.z, dry, options));
  report.lowered = lowerWhere(grid, options, [&](std::size_t i) {
    return options.has_land || (options.keep_land && i < before.size() && before[i] > 0.0);
  });
  measure(grid, report);
  return report;
}

std::size_t lowerToMinimum(Grid& grid, const DepthOptions& options) {
  return lowerWhere(grid, options, [&](std::size_t) { return options.has_land; });
}

}  // namespace coastmesh
