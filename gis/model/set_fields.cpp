#include "gis/model/set_fields.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include "gis/fields/field_names.hpp"
#include "gis/fields/node_fields.hpp"
#include "gis/for_count.hpp"
#include "gis/model/fill_depths.hpp"
#include "gis/places.hpp"
#include "gis/sample/raster_values.hpp"

namespace coastmesh {
namespace {

// The sources of one attribute.
struct FieldPlan {
  std::string name;
  std::optional<double> number;
  std::vector<FieldSource> rasters;
};

std::vector<FieldPlan> plansOf(const std::vector<FieldSource>& sources) {
  std::vector<FieldPlan> plans;
  for (const FieldSource& source : sources) {
    auto plan = std::ranges::find(plans, source.name, &FieldPlan::name);
    if (plan == plans.end()) plan = plans.insert(plan, FieldPlan{source.name, {}, {}});
    if (source.number)
      plan->number = source.number;
    else
      plan->rasters.push_back(source);
  }
  return plans;
}

std::size_t countUnknown(const std::vector<double>& values) {
  return static_cast<std::size_t>(std::ranges::count_if(values, [](double value) { return std::isnan(value); }));
}

std::vector<double> sampled(const Grid& grid, const FieldPlan& plan, DepthMethod method, FieldReport& report,
                            const RunControl& control, const ItemLoop& loop) {
  RasterValues search(grid, {method == DepthMethod::Average, isState(plan.name), BandValues::AsTheyAre, nullptr}, loop);
  for (const FieldSource& raster : plan.rasters) {
    std::optional<PixelClasses> classes;
    if (!raster.table.empty()) classes.emplace(raster.table);
    search.take({raster.file, classes ? &*classes : nullptr}, control);
  }
  std::vector<double> values = search.finish();
  for (double& value : values) value = roundedValue(value);
  report.nodes_of_file = search.counts().nodes_of_file;
  report.averaged = search.counts().averaged;
  report.notes = search.counts().notes;
  report.warnings = search.counts().warnings;
  return values;
}

// Nodes that rasters leave without a value get the attribute's number, else what they had.
void complete(const FieldPlan& plan, const NodeField* before, std::vector<double>& values, FieldReport& report) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isnan(values[i])) continue;
    if (plan.number) {
      values[i] = *plan.number;
      ++report.of_number;
    } else if (before != nullptr && !std::isnan(before->values[i])) {
      values[i] = before->values[i];
      ++report.kept;
    }
  }
}

std::size_t fillUnknown(const Grid& grid, DepthFill how, std::vector<double>& values, const ItemLoop& loop) {
  if (how == DepthFill::None) return 0;
  const std::size_t unknown = countUnknown(values);
  if (how == DepthFill::Neighbours)
    fillFromNeighbours(grid, values, roundedValue, loop);
  else
    fillFromNearest(grid, values, loop);
  fillWatersApart(grid, values);
  return unknown - countUnknown(values);
}

// A warning about nodes that are filled from others, however far, or stay unknown; empty if they are few.
std::string gapWarning(const Grid& grid, const std::vector<double>& values, const std::string& name, DepthFill how) {
  constexpr double kMuchWithout = 0.05;  // of the nodes: more is not just the edge of a raster
  const std::size_t unknown = countUnknown(values);
  if (static_cast<double>(unknown) <= kMuchWithout * static_cast<double>(values.size())) return {};
  const auto first = std::ranges::find_if(values, [](double value) { return std::isnan(value); });
  const Point& place = grid.nodes[static_cast<std::size_t>(first - values.begin())];
  if (unknown == values.size()) return "no raster of " + name + " has a value anywhere in the mesh; is its CRS right?";
  return "no raster of " + name + " has a value for " + std::to_string(unknown) + " of " +
         std::to_string(values.size()) + " nodes, the first at (" + roughPlaceInWords(place) +
         "): " + (how == DepthFill::None ? "they stay without one" : "theirs are made from other nodes, however far") +
         "; --attribute " + shortFieldName(name) + "= a number gives them that";
}

// A warning about classes that were taken for values.
std::string classWarning(const FieldReport& report) {
  const std::string word = shortFieldName(report.name);
  if ((word != "manning" && word != "drag") || !(report.greatest >= 1.0)) return {};
  char text[40];
  std::snprintf(text, sizeof text, "%.6g", report.greatest);
  return report.name + " is as large as " + text +
         ": if a raster holds classes of land cover, give the table of their values, --attribute " + word +
         "=FILE,TABLE.csv";
}

FieldReport setField(Grid& grid, const FieldPlan& plan, DepthMethod method, DepthFill how, const RunControl& control,
                     const ItemLoop& loop) {
  FieldReport report;
  report.name = plan.name;
  report.rasters = plan.rasters;
  NodeField* field = findField(grid, plan.name);
  std::vector<double> values = sampled(grid, plan, method, report, control, loop);
  complete(plan, field, values, report);
  if (std::string warning = gapWarning(grid, values, plan.name, how); !warning.empty())
    report.warnings.push_back(std::move(warning));
  report.filled =
      fillUnknown(grid, how == DepthFill::Neighbours && isState(plan.name) ? DepthFill::Nearest : how, values, loop);
  if (field == nullptr) {
    const FieldName* const known = findFieldName(plan.name);
    grid.node_fields.push_back({plan.name, known != nullptr ? std::string(known->unit) : std::string()});
    field = &grid.node_fields.back();
  }
  if (plan.number) field->usual = *plan.number;
  field->values = std::move(values);
  const FieldRange range = rangeOf(*field);
  report.unknown = range.unknown;
  report.least = range.least;
  report.greatest = range.greatest;
  if (std::string warning = classWarning(report); !warning.empty()) report.warnings.push_back(std::move(warning));
  return report;
}

}  // namespace

std::vector<FieldReport> setFields(Grid& grid, const std::vector<FieldSource>& sources, DepthMethod method,
                                   DepthFill fill, const RunControl& control, const ItemLoop& loop) {
  std::vector<FieldReport> reports;
  for (const FieldPlan& plan : plansOf(sources)) reports.push_back(setField(grid, plan, method, fill, control, loop));
  return reports;
}

}  // namespace coastmesh
