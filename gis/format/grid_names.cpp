#include "gis/format/grid_names.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "gis/places.hpp"

namespace coastmesh {
namespace {

constexpr std::string_view kFeature = "feature ", kIn = " in ";

}  // namespace

std::vector<std::string> regionNames(const Grid& grid) {
  std::set<std::string> names;
  for (const GridFeature& feature : grid.features)
    if (!feature.region.empty()) names.insert(feature.region);
  return {names.begin(), names.end()};
}

std::vector<int> regionNumbers(const Grid& grid, const std::vector<std::string>& names) {
  std::vector<int> numbers;
  for (const GridFeature& feature : grid.features) {
    const auto at = std::ranges::lower_bound(names, feature.region);
    numbers.push_back(feature.region.empty() ? 0 : static_cast<int>(at - names.begin()) + 1);
  }
  return numbers;
}

std::string quotable(std::string_view name) {
  std::string text(name);
  std::ranges::replace_if(
      text, [](char c) { return c == '"' || c == '\n' || c == '\r'; }, ' ');
  return text;
}

std::vector<std::string> featureLabels(const Grid& grid) {
  std::vector<std::string> labels;
  std::map<std::pair<std::int64_t, std::string>, std::size_t> times;
  for (const GridFeature& feature : grid.features) {
    std::string& label = labels.emplace_back(kFeature);
    label += std::to_string(feature.fid);
    const std::string region = quotable(feature.region);
    if (const std::size_t n = ++times[{feature.fid, region}]; n > 1) label += " (" + std::to_string(n) + ')';
    if (!region.empty()) label += std::string(kIn) + region;
  }
  return labels;
}

GridFeature featureOfLabel(const std::string& label, std::int64_t number) {
  if (label.starts_with(kFeature)) {
    std::int64_t fid = 0;
    const char* const end = label.data() + label.size();
    const auto [rest, error] = std::from_chars(label.data() + kFeature.size(), end, fid);
    if (error == std::errc()) {
      const std::string_view tail(rest, static_cast<std::size_t>(end - rest));
      const std::size_t in = tail.find(kIn);
      return {fid, {}, {}, in == std::string_view::npos ? "" : std::string(tail.substr(in + kIn.size()))};
    }
  }
  GridFeature feature{number, {}, {}};
  if (!label.empty()) feature.attributes.emplace_back("name", label);
  return feature;
}

std::string openingName(const Boundary& boundary, const Grid& grid) {
  return (boundary.name.empty() ? std::string(toString(boundary.role)) : "'" + boundary.name + "'") + " near " +
         pointText(grid.nodes[boundary.nodes[boundary.nodes.size() / 2]]);
}

void addFeatures(const std::vector<double>& fids, const std::vector<double>& regions,
                 const std::vector<std::string>& names, Grid& grid) {
  constexpr double kExact = 9007199254740992.0;  // 2^53
  const bool with_fids = !fids.empty() && std::ranges::all_of(fids, [](double fid) { return std::abs(fid) <= kExact; });
  if (!with_fids && regions.empty()) return;
  const auto regionAt = [&](std::size_t t) -> std::size_t {
    const double number = regions.empty() ? 0.0 : regions[t];
    return number >= 1.0 && number <= static_cast<double>(names.size()) ? static_cast<std::size_t>(number) : 0;
  };
  std::vector<std::pair<double, std::size_t>> of_triangle;
  for (std::size_t t = 0; t < (with_fids ? fids : regions).size(); ++t)
    of_triangle.emplace_back(with_fids ? fids[t] : 0.0, regionAt(t));
  std::vector<std::pair<double, std::size_t>> known = of_triangle;
  std::ranges::sort(known);
  const auto repeated = std::ranges::unique(known);
  known.erase(repeated.begin(), repeated.end());
  for (const auto& [fid, region] : known)
    grid.features.push_back({std::llround(fid), {}, {}, region == 0 ? std::string() : names[region - 1]});
  for (const auto& key : of_triangle)
    grid.feature_of.push_back(static_cast<std::uint32_t>(std::ranges::lower_bound(known, key) - known.begin()));
}

}  // namespace coastmesh
