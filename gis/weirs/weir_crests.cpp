#include "gis/weirs/weir_crests.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/metric.hpp"
#include "gis/coast/feature_names.hpp"
#include "gis/error.hpp"
#include "gis/finite_number.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/grid/grid_lines.hpp"
#include "gis/lower_case.hpp"
#include "gis/places.hpp"
#include "gis/weirs/line_view.hpp"

namespace coastmesh {
namespace {

std::optional<double> numberOf(const Feature& feature, const std::string& attribute, double least) {
  for (const auto& [key, value] : feature.attributes) {
    if (lowerCase(key) != attribute || value.empty()) continue;
    const std::optional<double> number = finiteNumber(value);
    if (!number || *number < least)
      throw InputError(featureInWords(feature) + ": its attribute '" + key + "' is " + value + ", not a number" +
                       (std::isfinite(least) ? " of 0 or more" : "") + "; correct it, or leave it empty");
    return number;
  }
  return std::nullopt;
}

WeirCrest crestOf(const Feature& feature, double zero_m) {
  WeirCrest crest;
  crest.height_m = numberOf(feature, kWeirHeight, -std::numeric_limits<double>::infinity());
  if (crest.height_m) *crest.height_m -= zero_m;
  crest.subcritical = numberOf(feature, kWeirSubcritical, 0.0).value_or(crest.subcritical);
  crest.supercritical = numberOf(feature, kWeirSupercritical, 0.0).value_or(crest.supercritical);
  return crest;
}

double squaredDistanceTo(const WeirSource& source, const LineView& view) {
  double least = std::numeric_limits<double>::infinity();
  for (const std::vector<Point>& line : source.lines)
    for (std::size_t i = 1; i < line.size(); ++i)
      least = std::min(least, squaredDistanceToSegment({}, view.of(line[i - 1]), view.of(line[i])));
  return least;
}

}  // namespace

std::string lineInWords(const Grid& grid, const GridLine& line, const WeirSource* source) {
  std::string text = line.name.empty() ? "the weir" : "weir '" + line.name + "'";
  if (source != nullptr && !source->feature.empty()) text += " (" + source->feature + ")";
  return text + " from " + roughPlaceInWords(grid.nodes[line.nodes.front()]);
}

std::vector<WeirSource> weirSources(const Coastline& coastline, double zero_m) {
  std::vector<WeirSource> sources;
  for (const Feature& feature : coastline.features)
    if (feature.use == FeatureUse::Weir)
      sources.push_back({lineNameOf(feature), feature.lines, crestOf(feature, zero_m), featureInWords(feature)});
  return sources;
}

const WeirSource* sourceOf(const Grid& grid, const GridLine& line, const std::vector<WeirSource>& sources) {
  std::vector<LineView> views;
  for (const auto& [a, b] : edgesOf(line))
    views.emplace_back(placeBetween(grid.crs, grid.nodes[a], grid.nodes[b], 0.5), grid.crs.geographic);
  const WeirSource* closest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const WeirSource& source : sources) {
    if (source.name != line.name) continue;
    double sum = 0.0;
    for (std::size_t i = 0; i < views.size() && sum < least; ++i) sum += squaredDistanceTo(source, views[i]);
    if (sum >= least) continue;
    least = sum;
    closest = &source;
  }
  return closest;
}

bool runsAsSource(const Grid& grid, const GridLine& line, const WeirSource& source) {
  const Point &from = grid.nodes[line.nodes[0]], &to = grid.nodes[line.nodes[1]];
  const LineView view(placeBetween(grid.crs, from, to, 0.5), grid.crs.geographic);
  double least = std::numeric_limits<double>::infinity(), along = 0.0;
  for (const std::vector<Point>& points : source.lines) {
    for (std::size_t i = 1; i < points.size(); ++i) {
      const Point a = view.of(points[i - 1]), b = view.of(points[i]);
      const double distance = squaredDistanceToSegment({}, a, b);
      if (distance >= least) continue;
      least = distance;
      along = dot(view.of(to) - view.of(from), b - a);
    }
  }
  return along >= 0.0;
}

}  // namespace coastmesh
