#include "apps/report/mesh_report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>

#include "apps/report/partition_report.hpp"
#include "apps/report/report_sections.hpp"
#include "apps/report/step_sections.hpp"
#include "gis/for_count.hpp"
#include "gis/grid/grid_lines.hpp"
#include "gis/places.hpp"
#include "parallel/deal.hpp"

namespace coastmesh {

namespace {

Json orNull(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json finiteOrNull(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json inputSection(const MeshJob& job, const MeshJobResult& result) {
  Json projections = Json::object();
  for (const auto& [description, count] : result.projections) projections[description] = count;
  Json refused = Json::array();
  for (const Refusal& refusal : result.refusals) {
    refused.push_back({{"source", refusal.source}, {"fids", refusal.fids}, {"reason", refusal.reason}});
  }
  Json section = readSection(job.input.files, result.read, result.crs);
  section.update(
      {{"projection", result.regions == 1 ? Json(result.first_projection) : Json(nullptr)},
       {"projection_reason", result.regions == 1 ? Json(result.first_projection_reason) : Json(nullptr)},
       {"scale", {{"least", finiteOrNull(result.least_scale)}, {"greatest", finiteOrNull(result.greatest_scale)}}},
       {"projections", std::move(projections)},
       {"area_m2", orNull(result.input_area_m2)},
       {"refused", std::move(refused)}});
  return section;
}

const char* xName(const Crs& crs) { return crs.geographic ? "lon" : "x"; }
const char* yName(const Crs& crs) { return crs.geographic ? "lat" : "y"; }

Json unresolvedSection(const MeshJobResult& result) {
  Json places = Json::array();
  for (const BoundViolationPlace& violation : result.short_of.places) {
    places.push_back({{xName(result.crs), violation.place.x},
                      {yName(result.crs), violation.place.y},
                      {"min_angle_deg", violation.min_angle_deg},
                      {"max_angle_deg", violation.max_angle_deg}});
  }
  return {{"count", result.short_of.count}, {"places", std::move(places)}};
}

Json refineSection(const MeshJob& job, const MeshJobResult& result) {
  const RefineOptions& options = job.mesh.refine;
  const RefineStats& stats = result.refine;
  const SizeOptions& sizes = result.sizes;
  return {{"algorithm", kAlgorithmNames[static_cast<std::size_t>(options.algorithm)]},
          {"min_angle_deg", options.min_angle_deg},
          {"max_angle_deg", options.max_angle_deg},
          {"size_max_m", finiteOrNull(sizes.most_m)},
          {"sized", sizes.any()},
          {"grade", sizes.gradation},
          {"estimated_vertices", sizes.any() ? finiteOrNull(std::round(result.estimated_vertices)) : Json(nullptr)},
          {"coarsen", job.mesh.coarsen},
          {"shrink", job.mesh.coarsen},  // deprecated: the former name of `coarsen`
          {"smooth", job.mesh.smooth},
          {"quality", kGoalNames[static_cast<std::size_t>(options.goal)]},
          {"steiner_points", stats.steiner_points},
          {"by_type",
           {{"I", stats.by_type[0]}, {"II", stats.by_type[1]}, {"III", stats.by_type[2]}, {"IV", stats.by_type[3]}}},
          {"segment_splits", stats.segment_splits},
          {"relocations", stats.relocations},
          {"removals", stats.removals},
          {"merges", stats.merges},
          {"regions", result.pieces},
          {"budget_reached", stats.budget_reached},
          {"unresolved", unresolvedSection(result)}};
}

Json turnedSection(const MeshJobResult& result) {
  Json places = Json::array();
  for (const Point& place : result.turned_places)
    places.push_back({{xName(result.crs), place.x}, {yName(result.crs), place.y}});
  return {{"count", result.turned}, {"places", std::move(places)}};
}

// The surface on which angles are measured, if all regions agree, and the number of regions on each.
Json surfaceSection(const MeshJobResult& result) {
  const bool one = result.surfaces.size() == 1;
  const auto nameOf = [](SurfaceKind kind) { return kSurfaceNames[static_cast<std::size_t>(kind)]; };
  Json regions = Json::object();
  for (const auto& [kind, count] : result.surfaces) regions[nameOf(kind)] = count;
  return {{"kind", one ? Json(nameOf(result.surfaces.begin()->first)) : Json(nullptr)},
          {"radius_m", result.surfaces.contains(SurfaceKind::Sphere) ? Json(kSphereRadius) : Json(nullptr)},
          {"regions", std::move(regions)}};
}

// Nodes minus edges plus triangles: 2 for a closed globe.
std::int64_t eulerNumber(const MeshJobResult& result) {
  std::size_t on_boundary = 0;
  for (const Boundary& boundary : result.grid.boundaries)
    on_boundary += boundary.closed ? boundary.nodes.size() : boundary.nodes.size() - 1;
  const std::size_t triangles = result.grid.triangles.size();
  return static_cast<std::int64_t>(result.grid.nodes.size()) - static_cast<std::int64_t>((triangles + on_boundary) / 2);
}

Json meshSection(const MeshJobResult& result) {
  const MeshQuality& quality = result.quality;
  const bool any = quality.triangles > 0;
  return {{"vertices", quality.vertices},
          {"triangles", quality.triangles},
          {"surface", surfaceSection(result)},
          {"closed", any && result.grid.boundaries.empty()},
          {"euler", eulerNumber(result)},
          {"area_m2", result.mesh_area_m2},
          {"min_angle_deg", any ? Json(quality.min_angle_deg) : Json(nullptr)},
          {"max_angle_deg", any ? Json(quality.max_angle_deg) : Json(nullptr)},
          {"below_bound", quality.bounds.below},
          {"below_bound_explained", quality.bounds.excused()},
          {"excused", {{"corner", quality.bounds.corner}, {"near", quality.bounds.near}}},
          {"unresolved", quality.bounds.unresolved()},
          {"angle_histogram", quality.angle_histogram},
          {"turned", turnedSection(result)},
          {"digest", digestText(result.digest)}};
}

// The number of lines of each kind.
Json lineSection(const Grid& grid) {
  Json section = Json::object();
  for (const LineKind kind : kLineKinds) {
    std::string key(toString(kind));
    std::ranges::replace(key, ' ', '_');
    section[key] = std::ranges::count(grid.lines, kind, &GridLine::kind);
  }
  return section;
}

Json timeSection(const PhaseSeconds& seconds) {
  return {{"read", seconds.read},         {"clean", seconds.clean},
          {"size", seconds.size},         {"triangulate", seconds.triangulate},
          {"refine", seconds.refine},     {"coarsen", seconds.coarsen},
          {"optimise", seconds.optimise}, {"stitch", seconds.stitch},
          {"check", seconds.check},       {"finish", seconds.finish},
          {"write", seconds.write},       {"total", seconds.total},
          {"shrink", seconds.coarsen},  // deprecated: the former name of `coarsen`
          {"fit", seconds.optimise}};   // and of `optimise`
}

// The expected speedup on more cores.
Json speedupSection(const WorkLog& log) {
  const double work = log.work();
  Json speedup = Json::object();
  for (const std::size_t cores : {2, 8, 64})
    speedup[std::to_string(cores)] = work > 0.0 ? work / log.timeOn(cores) : 1.0;
  return {{"work_s", work}, {"critical_path_s", log.criticalPath()}, {"speedup", std::move(speedup)}};
}

// Joins consecutive stages of the same name, except those whose items are listed: a map of sizes alone has hundreds.
Json stagesSection(const WorkLog& log) {
  Json stages = Json::array();
  for (const Stage& stage : log.stages) {
    const double sum = std::accumulate(stage.items.begin(), stage.items.end(), 0.0);
    const double longest = stage.items.empty() ? 0.0 : *std::ranges::max_element(stage.items);
    const bool listed =
        stage.name == "refine" || stage.name == "coarsen" || stage.name == "optimise" || stage.name == "regions";
    if (!listed && !stages.empty() && stages.back()["name"] == stage.name) {
      Json& same = stages.back();
      same["alone_s"] = same["alone_s"].get<double>() + stage.alone;
      same["items"] = same["items"].get<std::size_t>() + stage.items.size();
      same["work_s"] = same["work_s"].get<double>() + sum;
      same["longest_s"] = std::max(same["longest_s"].get<double>(), longest);
      continue;
    }
    stages.push_back({{"name", stage.name},
                      {"alone_s", stage.alone},
                      {"items", stage.items.size()},
                      {"work_s", sum},
                      {"longest_s", longest}});
    constexpr std::size_t kMostListed = 1000;
    if (listed && stage.items.size() <= kMostListed) stages.back()["item_s"] = stage.items;
  }
  return stages;
}

// Parallel work of the whole run, and of the stages between cleaning and checking.
Json parallelSection(const WorkLog& log) {
  Json section = speedupSection(log);
  section["meshing"] = speedupSection(
      log.only({"triangulate", "cut", "refine", "stitch", "coarsen", "optimise", "rest", "label", "regions"}));
  section["stages"] = stagesSection(log);
  return section;
}

// The ranks that worked on the mesh.
Json clusterSection(const Helpers* helpers, const std::vector<RasterUse>& rasters_read) {
  const HelpersUse use = helpers != nullptr ? helpers->use() : HelpersUse();
  Json by_rank = Json::array();
  for (std::size_t rank = 0; rank < use.peak_mib.size(); ++rank) {
    const RasterUse read = rank < rasters_read.size() ? rasters_read[rank] : RasterUse();
    by_rank.push_back({{"raster_files", read.files},
                       {"raster_bytes", read.bytes},
                       {"peak_memory_mib", rank == 0 ? peakMemoryMib() : use.peak_mib[rank]}});
  }
  return {{"ranks", use.ranks},
          {"pieces_dealt", use.pieces_dealt},
          {"bytes_moved", use.bytes_moved},
          {"by_rank", std::move(by_rank)}};
}

Json checkpointSection(const CheckpointUse& use) {
  return {{"groups_taken", use.groups_taken},
          {"regions_gone_on", use.regions_gone_on},
          {"rounds_kept", use.rounds_kept},
          {"bytes_kept", use.bytes_kept}};
}

}  // namespace

std::string digestText(std::uint64_t digest) {
  char text[20];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(digest));
  return text;
}

std::string meshReport(const MeshJob& job, const MeshJobResult& result, int threads,
                       const std::vector<std::string>& warnings) {
  const Json report{{"coastmesh", COASTMESH_VERSION},
                    {"warnings", warnings},
                    {"input", inputSection(job, result)},
                    {"clean", editsSection(result.edits)},
                    {"refine", refineSection(job, result)},
                    {"mesh", meshSection(result)},
                    {"depth", Json::parse(depthSection(job.finish, result.finish))},
                    {"attributes", Json::parse(fieldSection(result.finish))},
                    {"boundaries", Json::parse(boundarySection(job.finish, result.finish, result.grid))},
                    {"step", outcomeSection(result.step, result.sizes)},
                    {"lines", lineSection(result.grid)},
                    {"repairs", Json::parse(repairSection(result.finish))},
                    {"partition", partitionSection(result.partition)},
                    {"output_warnings", result.output_warnings},
                    {"time_s", timeSection(result.seconds)},
                    {"parallel", parallelSection(result.log)},
                    {"cluster", clusterSection(job.mesh.helpers, result.rasters_read)},
                    {"checkpoint", checkpointSection(result.checkpoint)},
                    {"peak_memory_mib", peakMemoryMib()},
                    {"threads", threads}};
  return textOf(report);
}

namespace {

// Edits by cleaning that may surprise; empty if there are none.
std::string cleaningText(const std::array<std::uint64_t, kEditKinds>& edits) {
  std::string text;
  for (const EditKind kind :
       {EditKind::Spike, EditKind::SelfCrossing, EditKind::FeaturesCross, EditKind::DegenerateRing,
        EditKind::FeaturesOverlap, EditKind::MisplacedRing, EditKind::RepeatedRing, EditKind::OutsideWater}) {
    const std::uint64_t count = edits[static_cast<std::size_t>(kind)];
    if (count > 0) text += (text.empty() ? "" : ", ") + std::string(toString(kind)) + " " + grouped(count);
  }
  return text.empty() ? "" : "mended in the input: " + text + "; --edits FILE has the places\n";
}

}  // namespace

std::string meshSummary(const MeshJob& job, const MeshJobResult& result) {
  const MeshQuality& quality = result.quality;
  char figures[200];
  std::snprintf(figures, sizeof figures, "smallest angle %.2f, largest %.2f degrees; %.2f s, %.0f MiB",
                quality.min_angle_deg, quality.max_angle_deg, result.seconds.total, peakMemoryMib());
  std::string text = grouped(quality.vertices) + " vertices, " + grouped(quality.triangles) +
                     forCount(quality.triangles, " triangle, ", " triangles, ") +
                     grouped(result.refine.steiner_points) +
                     forCount(result.refine.steiner_points, " Steiner point\n", " Steiner points\n") + figures + "\n";
  for (const auto& [kind, count] : result.surfaces)
    if (kind != SurfaceKind::Plane)
      text += "measured on the " + std::string(kSurfaceNames[static_cast<std::size_t>(kind)]) +
              (count < result.regions ? ": " + grouped(count) + " of " + grouped(result.regions) + " regions" : "") +
              "\n";
  if (result.sizes.any())
    text += "about " + grouped(static_cast<std::uint64_t>(std::min(result.estimated_vertices, 1e18))) +
            " vertices were expected from these sizes\n";
  if (quality.bounds.below > 0) text += boundText(quality.bounds) + "\n";
  if (result.short_of.count > 0) {
    const RefineOptions& asked = job.mesh.refine;
    char bound[80];
    std::snprintf(bound, sizeof bound, asked.max_angle_deg < 180.0 ? "%g to %g degrees" : "at least %g degrees",
                  asked.min_angle_deg, asked.max_angle_deg);
    text += grouped(result.short_of.count) + forCount(result.short_of.count, " triangle misses", " triangles miss") +
            " a requirement (" + bound;
    if (std::isfinite(result.sizes.most_m) && !result.sizes.any())
      text += amount(", --size-max %g", result.sizes.most_m);
    text += ")";
    if (!result.short_of.places.empty()) {
      const BoundViolationPlace& first = result.short_of.places.front();
      text += ", the first at " + pointText(first.place) + amount(" with angles of %.3g", first.min_angle_deg) +
              amount(" to %.4g degrees", first.max_angle_deg);
    }
    text += "\n";
  }
  text += stepText(result.step.step, result.crs.isPlane(), job.finish.targets) + "\n";
  text += cleaningText(result.edits);
  text += finishSummary(job.finish, result.finish);
  text += partitionText(result.partition);
  if (result.refine.budget_reached) text += "the vertex budget was reached before all angles were good\n";
  return text;
}

}  // namespace coastmesh
