#include <cmath>
#include <cstdarg>
#include <cstdio>

#include "apps/job/step_outcome.hpp"
#include "apps/report/file_info.hpp"
#include "apps/report/report_sections.hpp"
#include "apps/report/step_sections.hpp"
#include "gis/coast/feature_names.hpp"
#include "gis/for_count.hpp"

namespace coastmesh {

namespace {

constexpr int kHistogramWidth = 50;

Json extentJson(const Extent& extent) { return {extent.low.x, extent.low.y, extent.high.x, extent.high.y}; }

std::string dump(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

[[gnu::format(printf, 2, 3)]] void addLine(std::string& text, const char* format, ...) {
  char line[600];
  va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(line, sizeof line, format, arguments);
  va_end(arguments);
  text += line;
  text += '\n';
}

unsigned long long big(std::uint64_t number) { return number; }

void addExtent(std::string& text, const Extent& extent) {
  addLine(text, "extent          %.10g %.10g to %.10g %.10g", extent.low.x, extent.low.y, extent.high.x, extent.high.y);
}

// Shows the classes that are not empty, and those between them.
void addHistogram(std::string& text, const MeshQuality& quality) {
  const auto& counts = quality.angle_histogram;
  std::size_t first = 0;
  std::size_t last = counts.size();
  while (first < last && counts[first] == 0) ++first;
  while (last > first && counts[last - 1] == 0) --last;
  std::uint64_t most = 1;
  for (std::uint64_t count : counts) most = std::max(most, count);
  addLine(text, "angles");
  for (std::size_t i = first; i < last; ++i) {
    const double share = static_cast<double>(counts[i]) / static_cast<double>(most);
    const std::string bar(static_cast<std::size_t>(std::lround(share * kHistogramWidth)), '#');
    addLine(text, "  %3zu to %3zu  %10llu  %s", 5 * i, 5 * (i + 1), big(counts[i]), bar.c_str());
  }
}

}  // namespace

std::string toJson(const MeshInfo& info) {
  Json json{{"kind", "mesh"},
            {"crs", info.crs},
            {"nodes", info.nodes},
            {"triangles", info.triangles},
            {"pieces", info.pieces},
            {"features", info.features},
            {"boundaries", info.boundaries},
            {"extent", extentJson(info.extent)},
            {"area_m2", info.area_m2},
            {"surface", info.surface},
            {"closed", info.closed},
            {"euler", info.euler},
            {"min_angle_deg", info.quality.min_angle_deg},
            {"max_angle_deg", info.quality.max_angle_deg},
            {"shortest_edge_m", info.step.shortest_edge_m},
            {"longest_edge_m", info.longest_edge_m},
            {"step", stepSection(info.step)},
            {"angle_histogram", info.quality.angle_histogram}};
  if (info.quads.count > 0)
    json["quadrilaterals"] = {{"count", info.quads.count},
                              {"min_angle_deg", info.quads.min_angle_deg},
                              {"max_angle_deg", info.quads.max_angle_deg},
                              {"reflex", info.quads.reflex}};
  if (info.has_z) {
    json["z"] = {info.lowest_z, info.highest_z};
    json["nodes_without_z"] = info.nodes_without_z;
  }
  for (const FieldInfo& field : info.fields)
    json["attributes"].push_back(
        {{"name", field.name}, {"least", field.least}, {"greatest", field.greatest}, {"unknown", field.unknown}});
  return dump(json);
}

std::string toJson(const CoastlineInfo& info) {
  Json sources = Json::array();
  for (const auto& [name, features] : info.sources) sources.push_back({{"name", name}, {"features", features}});
  return dump({{"kind", "coastline"},
               {"crs", info.crs},
               {"features", info.features},
               {"sources", sources},
               {"groups", info.groups},
               {"rings", info.rings},
               {"holes", info.holes},
               {"lines", info.lines},
               {"points", info.points},
               {"skipped_empty", info.skipped_empty},
               {"skipped_points", info.skipped_points},
               {"extent", extentJson(info.extent)},
               {"area_m2", info.area_m2},
               {"shortest_edge_m", info.shortest_edge_m},
               {"longest_edge_m", info.longest_edge_m},
               {"zero_edges", info.zero_edges},
               {"warnings", info.warnings}});
}

std::string toJson(const PolyInfo& info) {
  return dump({{"kind", "poly"},
               {"points", info.points},
               {"segments", info.segments},
               {"holes", info.holes},
               {"extent", extentJson(info.extent)},
               {"shortest_edge", info.shortest_edge},
               {"longest_edge", info.longest_edge}});
}

std::string toText(const MeshInfo& info) {
  std::string text;
  std::string quads;
  if (info.quads.count > 0)
    quads = ", " + std::to_string(info.quads.count) + forCount(info.quads.count, " quadrilateral", " quadrilaterals");
  addLine(text, "mesh            %llu nodes, %llu %s%s", big(info.nodes), big(info.triangles),
          forCount(info.triangles, "triangle", "triangles"), quads.c_str());
  addLine(text, "pieces          %llu", big(info.pieces));
  if (info.features > 0) addLine(text, "features        %llu", big(info.features));
  for (const auto& [role, count] : info.boundaries) addLine(text, "boundaries      %llu %s", big(count), role.c_str());
  text += "crs             " + info.crs + "\n";
  addExtent(text, info.extent);
  if (info.has_z && info.nodes_without_z > 0) {
    addLine(text, "z               %.10g to %.10g m, unknown at %llu %s", info.lowest_z, info.highest_z,
            big(info.nodes_without_z), forCount(info.nodes_without_z, "node", "nodes"));
  } else if (info.has_z) {
    addLine(text, "z               %.10g to %.10g m", info.lowest_z, info.highest_z);
  }
  for (const FieldInfo& field : info.fields) {
    text += "attribute       " + field.name;
    addLine(text, " %.6g to %.6g%s", field.least, field.greatest,
            field.unknown > 0 ? (", unknown at " + std::to_string(field.unknown)).c_str() : "");
  }
  addLine(text, "area            %.10g m2", info.area_m2);
  addLine(text, "edges           %.6g to %.6g m", info.step.shortest_edge_m, info.longest_edge_m);
  text += "step            " + stepText(info.step, info.plane) + "\n";
  if (info.surface != "plane") text += "measured on     " + info.surface + "\n";
  if (info.quads.count > 0)
    addLine(text, "quadrilaterals  angles from %.3f to %.3f degrees", info.quads.min_angle_deg,
            info.quads.max_angle_deg);
  if (info.quads.reflex > 0) addLine(text, "not convex      %llu of them", big(info.quads.reflex));
  if (info.triangles == 0) return text;
  if (info.closed) text += "closed          nodes - edges + triangles = " + std::to_string(info.euler) + "\n";
  addLine(text, "smallest angle  %.3f degrees", info.quality.min_angle_deg);
  addLine(text, "largest angle   %.3f degrees", info.quality.max_angle_deg);
  addHistogram(text, info.quality);
  return text;
}

std::string toText(const CoastlineInfo& info) {
  std::string text;
  addLine(text, "features        %llu in %llu %s", big(info.features), big(info.groups),
          forCount(info.groups, "group that touches", "groups that touch"));
  if (info.sources.size() > 1)
    for (const auto& [name, features] : info.sources)
      text += "  in            " + sourceInWords(name) + ", " + std::to_string(features) + "\n";
  addLine(text, "rings           %llu, %llu of them %s", big(info.rings), big(info.holes),
          forCount(info.holes, "a hole", "holes"));
  if (info.lines > 0) addLine(text, "open lines      %llu", big(info.lines));
  addLine(text, "points          %llu", big(info.points));
  if (info.skipped_empty > 0) addLine(text, "empty features  %llu", big(info.skipped_empty));
  if (info.skipped_points > 0) addLine(text, "point features  %llu", big(info.skipped_points));
  text += "crs             " + info.crs + "\n";
  addExtent(text, info.extent);
  addLine(text, "area            %.10g m2", info.area_m2);
  addLine(text, "edges           %.6g to %.6g m", info.shortest_edge_m, info.longest_edge_m);
  if (info.zero_edges > 0) addLine(text, "zero edges      %llu", big(info.zero_edges));
  for (const std::string& warning : info.warnings) text += "warning         " + warning + "\n";
  return text;
}

std::string toText(const PolyInfo& info) {
  std::string text;
  addLine(text, "plane graph     %llu %s, %llu %s, %llu %s", big(info.points), forCount(info.points, "point", "points"),
          big(info.segments), forCount(info.segments, "segment", "segments"), big(info.holes),
          forCount(info.holes, "hole", "holes"));
  addExtent(text, info.extent);
  addLine(text, "segments        %.6g to %.6g long", info.shortest_edge, info.longest_edge);
  return text;
}

}  // namespace coastmesh
