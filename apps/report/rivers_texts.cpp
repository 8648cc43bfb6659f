#include "apps/report/rivers_texts.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "apps/report/remesh_texts.hpp"
#include "apps/report/report_sections.hpp"
#include "core/union_find.hpp"
#include "gis/for_count.hpp"
#include "gis/places.hpp"

namespace coastmesh {

namespace {

constexpr std::size_t kMostNamed = 20;  // rivers and places of one kind

std::string whyText(RiverLoss why) {
  switch (why) {
    case RiverLoss::Apart:
      return "not connected with the water of the mesh (--reach continues ends farther)";
    case RiverLoss::InWater:
      return "in the water of the mesh (--extent all has rows there too)";
    case RiverLoss::Crowded:
      return "without room beside others";
    case RiverLoss::Within:
      return "within wider ones, or given twice";
    case RiverLoss::Short:
      break;
  }
  return "shorter than a row, or than their width";
}

// A sentence for the rivers that are lost for one reason; empty if there are none.
std::string lostText(const std::vector<LostRiver>& all, RiverLoss why, const Grid& grid) {
  std::vector<std::string> places;
  for (const LostRiver& lost : all) {
    if (lost.why != why) continue;
    places.push_back(lost.name + " near " + pointText(lost.place));
    if (why == RiverLoss::Apart && std::isfinite(lost.distance) && lost.distance > 0.0)
      places.back() += ", " + lengthText(lost.distance, grid) + " away";
  }
  if (places.empty()) return {};
  return grouped(places.size()) + forCount(places.size(), " reach is", " reaches are") + " left out, " + whyText(why) +
         ": " + listed(places, kMostNamed);
}

std::string placesText(const std::vector<Point>& places) {
  std::vector<std::string> texts;
  for (const Point& place : places) texts.push_back(pointText(place));
  return listed(texts, kMostNamed);
}

}  // namespace

std::vector<std::string> lostRiverTexts(const RiverReport& report, const Grid& grid) {
  std::vector<std::string> texts;
  for (const RiverLoss why :
       {RiverLoss::Apart, RiverLoss::InWater, RiverLoss::Crowded, RiverLoss::Within, RiverLoss::Short})
    if (std::string text = lostText(report.lost, why, grid); !text.empty()) texts.push_back(std::move(text));
  return texts;
}

std::string riversText(const RiverReport& report, const Grid& grid) {
  std::string text = "rivers: " + grouped(report.reaches) + forCount(report.reaches, " reach, ", " reaches, ") +
                     grouped(report.quads) + forCount(report.quads, " quadrilateral", " quadrilaterals");
  if (report.junctions > 0)
    text += ", " + grouped(report.triangles) + " triangles at " + grouped(report.junctions) +
            forCount(report.junctions, " junction", " junctions");
  text += ", " + grouped(report.inflows) + forCount(report.inflows, " river boundary", " river boundaries") + "\n";
  if (!report.extended.empty())
    text += "continued to the water of the mesh: " + grouped(report.extended.size()) +
            forCount(report.extended.size(), " end", " ends") + ", near " + placesText(report.extended) + "\n";
  if (!report.left.empty())
    text += "close to the water of the mesh, but not continued to it, since the river has another way there: " +
            grouped(report.left.size()) + forCount(report.left.size(), " end", " ends") + ", near " +
            placesText(report.left) + " (--reach continues them too)\n";
  if (!report.led_out.empty())
    text += "continued over land past the edge of the mesh: " + grouped(report.led_out.size()) +
            forCount(report.led_out.size(), " end", " ends") + ", near " + placesText(report.led_out) + "\n";
  if (report.moved_m > 0.0)
    text += "centre lines that turn too sharply for their width moved by at most " + lengthText(report.moved_m, grid) +
            ", near " + pointText(report.moved_place) + "\n";
  return text;
}

std::string measuredRiversText(const MeasuredRivers& measured, const Grid& mesh) {
  std::string text =
      "widths from banks along " + lengthText(measured.measured_m, mesh) + " of " + lengthText(measured.length_m, mesh);
  if (measured.measured_m > 0.0)
    text += ", from " + lengthText(measured.least_width_m, mesh) + " to " + lengthText(measured.most_width_m, mesh);
  if (measured.without > 0)
    text += "; " + grouped(measured.without) +
            forCount(measured.without, " line that is outside them keeps its own",
                     " lines that are outside them keep their own");
  return text + "\n";
}

std::string landEndsText(const RiverReport& report) {
  const std::size_t count = report.on_land.size();
  if (count == 0) return {};
  std::vector<std::string> places;
  for (const LandEnd& end : report.on_land)
    places.push_back((end.name.empty() ? "" : "'" + end.name + "' ") + "near " + pointText(end.place));
  return grouped(count) + forCount(count, " river ends", " rivers end") +
         " on dry land within the mesh, without a boundary for a discharge: " + listed(places, kMostNamed) + "; draw " +
         forCount(count, "it", "them") +
         " on past the edge of the mesh, or leave the land upstream out of the mesh; a mouth has to end in the water";
}

std::string narrowedRiversText(const RiverReport& report) {
  if (report.narrowed == 0) return {};
  return grouped(report.narrowed) +
         forCount(report.narrowed, " reach comes closer to itself than its width, and is",
                  " reaches come closer to themselves than their width, and are") +
         " narrower there: near " + pointText(report.narrowed_place);
}

std::string junctionTrianglesText(const RiverReport& report) {
  if (report.below == 0) return {};
  return grouped(report.below) +
         forCount(report.below, " triangle at a junction of rivers misses", " triangles at junctions of rivers miss") +
         " --min-angle, beside quadrilaterals that leave no room for it; the smallest angle is " +
         amount("%.1f", report.least_angle_deg) + " degrees, near " + pointText(report.least_place);
}

std::string unconnectedRiversText(const Grid& grid, const std::vector<MergeSource>& triangles) {
  UnionFind waters(grid.nodes.size());
  for (const auto& corners : grid.triangles) {
    waters.unite(corners[0], corners[1]);
    waters.unite(corners[0], corners[2]);
  }
  std::vector<std::uint8_t> is_of_mesh(grid.nodes.size(), 0);
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (triangles[t].mesh == 0) is_of_mesh[waters.find(grid.triangles[t][0])] = 1;
  std::map<std::uint32_t, std::string> apart;  // by water: a river of it
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const std::uint32_t water = waters.find(grid.triangles[t][0]);
    if (is_of_mesh[water] != 0 || apart.contains(water)) continue;
    std::string& river = apart[water] = "near " + pointText(grid.nodes[grid.triangles[t][0]]);
    if (grid.feature_of.empty()) continue;
    for (const auto& [key, value] : grid.features[grid.feature_of[t]].attributes)
      if (key == "name") river = "'" + value + "' " + river;
  }
  if (apart.empty()) return {};
  std::string text = grouped(apart.size()) + forCount(apart.size(), " river is", " rivers are") +
                     " not connected with the water of the mesh, which is too narrow where they end: ";
  std::size_t count = 0;
  for (const auto& [water, river] : apart)
    if (++count <= kMostNamed) text += (count > 1 ? ", " : "") + river;
  return text + (count > kMostNamed ? ", and more" : "") + "; draw them farther into the water";
}

std::string riverBoundariesText(const Grid& grid) {
  std::string text;
  std::size_t rivers = 0, openings = 0;
  for (std::size_t b = 0; b < grid.boundaries.size(); ++b) {
    const Boundary& boundary = grid.boundaries[b];
    const bool is_river = boundary.role == BoundaryRole::River;
    if (is_river || boundary.role == BoundaryRole::Open) ++openings;
    if (!is_river || ++rivers > kMostNamed) continue;
    text += "  " + grouped(b + 1) + ", " + grouped(openings) + ": " +
            (boundary.name.empty() ? "without a name" : "'" + boundary.name + "'") + ", " +
            grouped(boundary.nodes.size()) + " nodes, near " +
            pointText(grid.nodes[boundary.nodes[boundary.nodes.size() / 2]]) + "\n";
  }
  if (rivers == 0) return {};
  if (rivers > kMostNamed) text += "  and " + grouped(rivers - kMostNamed) + " more\n";
  return "river boundaries, by number among all boundaries, and among the open ones of hgrid.gr3:\n" + text;
}

}  // namespace coastmesh
