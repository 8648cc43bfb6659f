#include "gis/fields/node_fields.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "gis/error.hpp"
#include "gis/fields/field_names.hpp"
#include "gis/places.hpp"

namespace coastmesh {

namespace {

template <typename AnyGrid>
auto* findIn(AnyGrid& grid, const std::string& name, std::uint32_t component) {
  const auto found = std::ranges::find_if(
      grid.node_fields, [&](const NodeField& field) { return field.name == name && field.component == component; });
  return found == grid.node_fields.end() ? nullptr : &*found;
}

}  // namespace

NodeField* findField(Grid& grid, const std::string& name, std::uint32_t component) {
  return findIn(grid, name, component);
}

const NodeField* findField(const Grid& grid, const std::string& name, std::uint32_t component) {
  return findIn(grid, name, component);
}

double mostFrequentOf(const NodeField& field) {
  std::vector<double> values = field.values;
  std::erase_if(values, [](double value) { return std::isnan(value); });
  std::ranges::sort(values);
  double found = std::numeric_limits<double>::quiet_NaN();
  std::ptrdiff_t most = 0;
  for (auto first = values.begin(); first != values.end();) {
    const auto end = std::upper_bound(first, values.end(), *first);
    if (end - first > most) {
      most = end - first;
      found = *first;
    }
    first = end;
  }
  return found;
}

double defaultOf(const NodeField& field) {
  if (!std::isnan(field.usual)) return field.usual;
  const FieldName* const known = findFieldName(field.name);
  if (known != nullptr && !std::isnan(known->usual)) return known->usual;
  return mostFrequentOf(field);
}

std::string titleOf(const NodeField& field) {
  return field.component == 0 ? field.name : field.name + ' ' + std::to_string(field.component);
}

std::string wordOf(const NodeField& field) {
  const std::string word = shortFieldName(field.name);
  return field.component == 0 ? word : word + '_' + std::to_string(field.component);
}

std::string variableWordOf(const NodeField& field) {
  const std::string word = asWord(field.name);
  return field.component == 0 ? word : word + '_' + std::to_string(field.component);
}

double roundedValue(double value) {
  if (!std::isfinite(value)) return value;
  char text[40];
  constexpr int kDigits = 7;
  const auto [end, error] = std::to_chars(text, text + sizeof text, value, std::chars_format::scientific, kDigits - 1);
  double rounded = value;
  if (error == std::errc()) std::from_chars(text, end, rounded);
  return rounded + 0.0;  // never -0
}

void roundStates(Grid& grid) {
  for (NodeField& field : grid.node_fields)
    if (isState(field.name))
      for (double& value : field.values)
        if (!std::isnan(value)) value = value < 0.5 ? 0.0 : 1.0;
}

void requireFields(const Grid& grid, const std::string& path) {
  for (const NodeField& field : grid.node_fields) {
    const auto unknown = std::ranges::find_if(field.values, [](double value) { return std::isnan(value); });
    if (unknown == field.values.end()) continue;
    const auto node = static_cast<std::size_t>(unknown - field.values.begin());
    throw OutputError("cannot write '" + path + "': " + titleOf(field) + " is not known at node " +
                      std::to_string(node + 1) + " at (" + roughPlaceInWords(grid.nodes[node]) +
                      "); give --attribute " + shortFieldName(field.name) + "= a number for nodes without a value");
  }
}

FieldRange rangeOf(const NodeField& field) {
  FieldRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(), 0};
  for (const double value : field.values) {
    if (std::isnan(value)) {
      ++range.unknown;
      continue;
    }
    range.least = std::min(range.least, value);
    range.greatest = std::max(range.greatest, value);
  }
  if (range.unknown == field.values.size()) range.least = range.greatest = 0.0;
  return range;
}

std::vector<std::string> addMissingFields(Grid& grid, const Grid& other) {
  std::vector<std::string> names;
  for (const NodeField& field : other.node_fields) {
    if (findField(grid, field.name, field.component) != nullptr) continue;
    const double usual = defaultOf(field);
    grid.node_fields.push_back({field.name, field.unit, field.component, usual, {}});
    grid.node_fields.back().values.assign(grid.nodes.size(), usual);
    if (names.empty() || names.back() != field.name) names.push_back(field.name);
  }
  return names;
}

}  // namespace coastmesh
