#include "apps/report/remesh_texts.hpp"

#include <cmath>
#include <cstdint>

#include "apps/report/report_sections.hpp"
#include "core/metric.hpp"
#include "gis/for_count.hpp"
#include "gis/grid/local_plane.hpp"
#include "gis/places.hpp"

namespace coastmesh {

std::string lengthText(double length, const Grid& grid) {
  constexpr double kWhole = 1000.0;  // without decimals from here on
  const std::string number =
      length >= kWhole ? grouped(static_cast<std::uint64_t>(std::llround(length))) : amount("%.3g", length);
  return number + (grid.crs.isPlane() ? "" : " m");
}

std::string figuresText(const TriangleFigures& figures, const Grid& grid) {
  return grouped(figures.triangles) + forCount(figures.triangles, " triangle", " triangles") + ", edges from " +
         lengthText(figures.shortest_m, grid) + " to " + lengthText(figures.longest_m, grid) + ", angles from " +
         amount("%.1f", figures.min_angle_deg) + " degrees\n";
}

std::vector<std::string> newNodeWarnings(const RemeshReport& report, const DepthOptions& depth) {
  std::vector<std::string> all;
  if (report.worst_below)
    all.push_back(
        grouped(report.below_bounds) + forCount(report.below_bounds, " new triangle misses", " new triangles miss") +
        " the bounds on angles, beside edges that have to stay; the smallest angle is " +
        amount("%.1f", report.worst_below->min_angle_deg) + " degrees, at " + pointText(report.worst_below->place));
  if (depth.files.empty()) return all;
  all.insert(all.end(), report.depth.warnings.begin(), report.depth.warnings.end());
  if (report.depth.unknown > 0)
    all.push_back(grouped(report.depth.unknown) + forCount(report.depth.unknown, " new node has", " new nodes have") +
                  " no depth, as no raster and no node around has one");
  return all;
}

std::string repairedText(const RepairedTriangles& repaired, const Grid& grid) {
  return repaired.figures.triangles == 0 ? "" : "changed by repairs: " + figuresText(repaired.figures, grid);
}

std::string repairedWarning(const RepairedTriangles& repaired) {
  if (repaired.below == 0) return {};
  return grouped(repaired.below) +
         forCount(repaired.below, " triangle that repairs changed misses", " triangles that repairs changed miss") +
         " the bounds on angles; the smallest angle is " + amount("%.1f", repaired.worst.min_angle_deg) +
         " degrees, at " + pointText(repaired.worst.place);
}

std::string lostWaterText(const MergeReport& merged) {
  constexpr double kMuch = 0.05;  // of the area replaced
  double replaced = 0.0;
  for (const auto& corners : merged.gone.triangles) {
    const auto [a, b, c] = localPlane(merged.gone, corners);
    replaced += 0.5 * std::abs(cross(b - a, c - a));
  }
  if (merged.lost.area_m2 <= kMuch * replaced) return {};
  return grouped(static_cast<std::uint64_t>(std::llround(merged.lost.area_m2))) +
         " square metres of water are left out, where no good triangles fit between "
         "the two meshes, most of it near " +
         pointText(merged.lost.place);
}

}  // namespace coastmesh
