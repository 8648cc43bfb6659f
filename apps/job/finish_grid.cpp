#include "apps/job/finish_grid.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <iterator>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <span>

#include "apps/job/mesh_area.hpp"
#include "core/quality.hpp"
#include "core/run_control.hpp"
#include "gis/check/check_weirs.hpp"
#include "gis/fields/node_fields.hpp"
#include "gis/fields/plain_field.hpp"
#include "gis/follow/water_notes.hpp"
#include "gis/for_count.hpp"
#include "gis/grid/local_plane.hpp"
#include "gis/places.hpp"
#include "gis/weirs/open_weirs.hpp"

namespace coastmesh {

namespace {

using Json = nlohmann::ordered_json;

std::string nameOf(Target target) { return kTargetNames[static_cast<std::size_t>(target)]; }
std::string nameOf(const Repair& repair) { return repair.target ? nameOf(*repair.target) : "time step"; }

constexpr double kMuchWater = 0.02;  // share of all water; losing more affects models

// The places that are nodes of the grid, each once, in the order of `lexLess`.
std::vector<Point> nodesAmong(const Grid& grid, std::vector<Point> places) {
  if (places.empty()) return places;
  std::ranges::sort(places, lexLess);
  std::vector<Point> nodes;
  for (const Point& node : grid.nodes)
    if (std::ranges::binary_search(places, node, lexLess)) nodes.push_back(node);
  std::ranges::sort(nodes, lexLess);
  const auto repeated = std::ranges::unique(nodes);
  nodes.erase(repeated.begin(), repeated.end());
  return nodes;
}

std::string textOf(const DroppedWaters& dropped) {
  return areaInWords(dropped.area_m2, dropped.in_plane) + amount(" (%.2g %%)", 100.0 * dropped.share) +
         " of the water is left out, " + std::to_string(dropped.waters) +
         forCount(dropped.waters, " water", " waters") + " of other features without a connection to " +
         (dropped.at_open > 0 ? "the main water, " + std::to_string(dropped.at_open) + " of them with an open boundary"
                              : "an open boundary") +
         ": the largest at " + pointText(dropped.place) + "; --keep-water all keeps them";
}

// A bound on angles for repairs of a mesh that was made elsewhere, degrees: nearly all of its triangles keep it.
double boundOfMesh(const Grid& grid) {
  constexpr double kMostDeg = 25.0, kShareBelow = 0.01;
  constexpr std::size_t kMostSampled = 100'000;
  const std::size_t stride = grid.triangles.size() / kMostSampled + 1;
  std::vector<double> angles;
  for (std::size_t t = 0; t < grid.triangles.size(); t += stride) {
    const auto p = localPlane(grid, grid.triangles[t]);
    angles.push_back(leastAngleDeg(p[0], p[1], p[2]));
  }
  if (angles.empty()) return 0.0;
  const auto low = angles.begin() + static_cast<std::ptrdiff_t>(kShareBelow * static_cast<double>(angles.size()));
  std::ranges::nth_element(angles, low);
  return std::min(kMostDeg, *low);
}

RepairLoss lossOf(double before_m2, const Grid& grid, const ItemLoop& loop) {
  const double lost = std::max(0.0, before_m2 - meshArea(grid, loop));
  return {lost, before_m2 > 0.0 ? lost / before_m2 : 0.0, grid.crs.isPlane()};
}

std::string textOf(const RepairLoss& lost, const std::vector<Repair>& repairs) {
  const auto orphans =
      static_cast<std::size_t>(std::ranges::count(repairs, TargetDefectKind::OrphanCell, &Repair::kind));
  return "repairs took out " + areaInWords(lost.area_m2, lost.in_plane) + amount(" (%.2g %%)", 100.0 * lost.share) +
         " of the water, with " + std::to_string(orphans) +
         forCount(orphans, " triangle that has no neighbour", " triangles that have no neighbours") +
         ": much of the water is too narrow for its elements; smaller sizes keep more of it";
}

std::string summaryOf(const FieldReport& field) {
  std::string text;
  for (const std::string& note : field.notes) text += note + "\n";
  return text + field.name + amount(" from %.6g", field.least) + amount(" to %.6g", field.greatest) + "; " +
         std::to_string(field.filled) + forCount(field.filled, " node", " nodes") + " filled, " +
         std::to_string(field.unknown) + " unknown\n";
}

// The land of a flood plain: by the coastline that was meshed, else by an attribute that the grid has.
LandFlags landOf(const Grid& grid, const FinishOptions& options, const ItemLoop& loop) {
  if (options.plain != nullptr) return landFlags(grid, options.plain, loop);
  LandFlags flags;
  flags.nodes = landNodes(grid);
  if (flags.nodes.empty()) return flags;
  for (const auto& corners : grid.triangles)
    flags.triangles.push_back(
        std::ranges::any_of(corners, [&flags](std::uint32_t v) { return flags.nodes[v] != 0; }) ? 1 : 0);
  return flags;
}

// The attribute that the grid is to have of rasters is for its depths already.
void readPlain(Grid& grid, const FinishOptions& options, const RunControl& control, const ItemLoop& loop) {
  if (options.plain != nullptr || grid.triangles.empty()) return;
  std::vector<FieldSource> sources = options.fields;
  std::erase_if(sources, [](const FieldSource& source) { return source.name != kFloodPlain; });
  if (!sources.empty())
    setFields(grid, sources, options.depth.method, options.depth.fill, RunControl{control.cancelled, {}}, loop);
}

// Depths open no boundary on the land of a flood plain, whatever its height.
BoundaryReport boundariesOf(Grid& grid, const FinishOptions& options, const ItemLoop& loop) {
  const bool by_depth = options.boundaries.opensByDepth() && !grid.z.empty();
  if (!by_depth) return assignBoundaries(grid, options.boundaries, loop);
  const std::vector<double> heights = grid.z;
  const LandFlags land = landOf(grid, options, loop);
  for (std::size_t v = 0; v < grid.z.size(); ++v)
    if (land.isLandNode(v)) grid.z[v] = std::max(grid.z[v], 0.0);
  BoundaryReport report = assignBoundaries(grid, options.boundaries, loop);
  grid.z = heights;
  return report;
}

// Finds the flood plain's land below the water, which ADCIRC gets an attribute for, unless the user gives it, or the
// grid has it. The land itself is an attribute too, for edits of the grid.
void markLand(Grid& grid, const FinishOptions& options, const std::vector<Target>& targets, const ItemLoop& loop,
              FinishReport& report) {
  if (options.plain == nullptr && !hasPlain(grid)) return;
  const auto isGiven = [&options](std::string_view name) {
    return std::ranges::find(options.fields, name, &FieldSource::name) != options.fields.end();
  };
  const LandFlags land = landOf(grid, options, loop);
  if (!isGiven(kFloodPlain)) markPlain(grid, land.nodes);
  report.low = findLowLand(grid, land);
  const bool has_it = options.plain == nullptr && findField(grid, std::string(kStartsDry)) != nullptr;
  const bool for_adcirc = std::ranges::find(targets, Target::Adcirc) != targets.end();
  report.starts_dry = for_adcirc && !isGiven(kStartsDry) && !has_it && !report.low.apart.empty();
  if (report.starts_dry) markStartDry(grid, report.low);
}

// Weirs between pairs of nodes are walls to other models, so these keep the edges.
void openWeirsOf(Grid& grid, const FinishOptions& options, std::span<const Target> targets, double min_angle_deg,
                 const RunControl& control, const ItemLoop& loop, FinishReport& report) {
  if (std::ranges::find(targets, Target::Adcirc) == targets.end()) return;
  const auto hasCrest = [&options](const WeirSource& weir) {
    return weir.crest.height_m.has_value() || !options.crests.files.empty();
  };
  if (targets.size() == 1) {
    report.crests = findRasterCrests(grid, options.weirs, options.crests, RunControl{control.cancelled, {}}, loop);
    report.weirs = openWeirs(grid, options.weirs, min_angle_deg, loop, report.crests);
  } else if (std::ranges::any_of(options.weirs, hasCrest)) {
    report.weirs.warnings.push_back(
        "weirs stay edges of the mesh: it is for other models besides ADCIRC, which would "
        "get walls; give --target adcirc alone for weirs with pairs of nodes");
  }
  report.beds = fitWeirsToBeds(grid);
  for (TargetDefect& defect : checkWeirs(grid)) report.repairs.left.emplace_back(Target::Adcirc, std::move(defect));
}

}  // namespace

std::vector<std::string> FinishReport::notes() const {
  std::vector<std::string> all;
  if (dry.edges > 0)
    all.push_back(std::to_string(dry.edges) +
                  forCount(dry.edges, " edge of the frame's sides lies on land and is",
                           " edges of the frame's sides lie on land and are") +
                  " no open boundary" + amount(", %.3g km in all", dry.length_m / 1000.0) + ", the first at " +
                  pointText(dry.place));
  if (std::string note = noteOf(low, starts_dry); !note.empty()) all.push_back(std::move(note));
  if (dropped.waters > 0 && dropped.share <= kMuchWater) all.push_back(textOf(dropped));
  all.insert(all.end(), crests.notes.begin(), crests.notes.end());
  std::ranges::move(weirs.notes(), std::back_inserter(all));
  return all;
}

std::vector<std::string> FinishReport::warnings() const {
  std::vector<std::string> all = depth.warnings;
  for (const FieldReport& field : fields) std::ranges::copy(field.warnings, std::back_inserter(all));
  all.insert(all.end(), boundaries.warnings.begin(), boundaries.warnings.end());
  for (const MissedOfFile& file : boundaries.missed) std::ranges::move(missedWarnings(file), std::back_inserter(all));
  std::map<std::pair<Target, TargetDefectKind>, std::pair<std::size_t, Point>> left;
  for (const auto& [target, defect] : repairs.left)
    ++left.try_emplace({target, defect.kind}, 0, defect.place).first->second.first;
  for (const auto& [which, count] : left)
    all.push_back("could not be repaired for " + nameOf(which.first) + ": " + std::string(toString(which.second)) +
                  ", " + std::to_string(count.first) + " in all, the first at " + pointText(count.second));
  if (dropped.share > kMuchWater) all.push_back(textOf(dropped));
  if (lost.share > kMuchWater) all.push_back(textOf(lost, repairs.repairs));
  if (!lost_asked.empty())
    all.push_back(
        std::to_string(lost_asked.size()) +
        forCount(lost_asked.size(), " point of --constraints is no node", " points of --constraints are no nodes") +
        " of the mesh, since the water there is left out, or its triangle has no neighbour: the first at " +
        pointText(lost_asked.front()));
  if (apart > 0)
    all.push_back(std::to_string(apart) + forCount(apart, " water has", " waters have") +
                  " no connection to an open boundary; check names their places, and --coast follow with --keep-water "
                  "open leaves them out");
  all.insert(all.end(), crests.warnings.begin(), crests.warnings.end());
  all.insert(all.end(), weirs.warnings.begin(), weirs.warnings.end());
  return all;
}

FinishReport finishGrid(Grid& grid, const FinishOptions& options, const RunControl& control, const ItemLoop& loop) {
  constexpr int kRounds = 3;
  constexpr ProgressPart kDepths{0.0, 0.3}, kFirst{0.3, 0.7}, kFurther{0.7, 1.0};
  FinishReport report;
  report.mended = !options.targets.empty() || options.repair.time_step_s > 0.0;
  const RunControl of_depths = report.mended ? stageControl(control, kDepths) : control;
  const std::vector<Point> asked = nodesAmong(grid, options.repair.asked);
  const std::vector<Target> targets = targetsNamed(options.targets);
  DepthOptions depth = options.depth;
  depth.keep_known = hasDepths(grid);
  readPlain(grid, options, control, loop);
  depth.has_land = depth.has_land || hasPlain(grid);
  depth.landOf = [&](const Grid& of) { return landOf(of, options, loop).nodes; };
  if (!grid.triangles.empty()) report.depth = setDepths(grid, depth, of_depths, loop);
  if (options.close_dry && !options.depth.files.empty())
    report.dry = closeDrySides(grid, options.depth.has_land, landOf(grid, options, loop), loop);
  if (!grid.triangles.empty()) report.boundaries = boundariesOf(grid, options, loop);
  if (options.drop_apart) report.dropped = dropApartWaters(grid, options.grazed, loop);
  // The report is of the water that is left.
  if (report.dropped.waters > 0 && !depth.files.empty()) report.depth = setDepths(grid, depth, of_depths, loop);
  const double before_m2 = report.mended ? meshArea(grid, loop) : 0.0;
  RepairMemory memory;
  RepairOptions how = options.repair;
  if (report.mended && how.min_angle_deg <= 0.0) how.min_angle_deg = boundOfMesh(grid);
  if (!grid.triangles.empty() && report.mended)
    report.repairs = repairForTargets(grid, targets, how, &memory, stageControl(control, kFirst), loop);
  // Nodes that repairs made or moved get new depths, which may put openings above the water or make time steps too
  // short: hence further rounds.
  const auto ofDepths = [](const Repair& repair) { return repair.kind == TargetDefectKind::DryOpening; };
  bool changed = !std::ranges::all_of(report.repairs.repairs, ofDepths);
  for (int round = 0; round < kRounds && changed && !options.depth.files.empty(); ++round) {
    const std::vector<std::string> warnings = std::move(report.depth.warnings);
    const ProgressPart part = kFurther.part(static_cast<double>(round) / kRounds, (round + 1.0) / kRounds);
    report.depth = setDepths(grid, depth, stageControl(control, part.part(0.0, 0.5)), loop);
    report.depth.warnings = warnings;
    std::erase_if(report.repairs.repairs, ofDepths);
    RepairReport again =
        repairForTargets(grid, targets, how, &memory, stageControl(control, part.part(0.5, 1.0)), loop);
    changed = !std::ranges::all_of(again.repairs, ofDepths);
    std::ranges::move(again.repairs, std::back_inserter(report.repairs.repairs));
    report.repairs.left = std::move(again.left);
  }
  // Nodes that the last repairs moved between water and land.
  if (depth.has_land) report.depth.lowered += lowerToMinimum(grid, depth);
  // Of the nodes that there are in the end.
  if (!grid.triangles.empty())
    report.fields = setFields(grid, options.fields, options.depth.method, options.depth.fill, control, loop);
  markLand(grid, options, targets, loop, report);
  if (report.mended) report.lost = lossOf(before_m2, grid, loop);
  std::ranges::set_difference(asked, nodesAmong(grid, asked), std::back_inserter(report.lost_asked), lexLess);
  if (!targets.empty() && !isOneWater(grid, loop)) report.apart = apartWaters(grid, loop).size();
  openWeirsOf(grid, options, targets, how.min_angle_deg, control, loop, report);
  return report;
}

std::string finishSummary(const FinishOptions& options, const FinishReport& report) {
  std::string text;
  for (const std::string& note : report.depth.notes) text += note + "\n";
  if (!options.depth.files.empty()) {
    char line[160];
    const bool any = std::ranges::any_of(report.depth.nodes_of_file, [](std::size_t nodes) { return nodes > 0; });
    int length = any ? std::snprintf(line, sizeof line, "depths from %.6g to %.6g m", report.depth.least_m,
                                     report.depth.greatest_m)
                     : std::snprintf(line, sizeof line, "no depths");
    std::snprintf(line + length, sizeof line - static_cast<std::size_t>(length),
                  "; %zu %s filled, %zu unknown, %zu above the water\n", report.depth.filled,
                  forCount(report.depth.filled, "node", "nodes"), report.depth.unknown, report.depth.above_water);
    text += line;
  }
  for (const FieldReport& field : report.fields) text += summaryOf(field);
  for (const std::string& note : report.beds.notes()) text += note + "\n";
  constexpr std::size_t kRepairsShown = 20;
  const std::vector<Repair>& repairs = report.repairs.repairs;
  for (std::size_t i = 0; i < std::min(kRepairsShown, repairs.size()); ++i)
    text += nameOf(repairs[i]) + ": " + std::string(toString(repairs[i].kind)) + " at " + pointText(repairs[i].place) +
            ": " + repairs[i].what + "\n";
  if (repairs.size() > kRepairsShown)
    text += "and " + std::to_string(repairs.size() - kRepairsShown) + " more repairs\n";
  return text;
}

std::string repairSection(const FinishReport& report) {
  if (!report.mended) return "null";
  Json done = Json::array(), left = Json::array();
  for (const Repair& repair : report.repairs.repairs)
    done.push_back({{"target", repair.target ? Json(nameOf(*repair.target)) : Json(nullptr)},
                    {"defect", toString(repair.kind)},
                    {"x", repair.place.x},
                    {"y", repair.place.y},
                    {"repair", repair.what}});
  for (const auto& [target, defect] : report.repairs.left)
    left.push_back(
        {{"target", nameOf(target)}, {"defect", toString(defect.kind)}, {"x", defect.place.x}, {"y", defect.place.y}});
  return Json{{"done", std::move(done)},
              {"left", std::move(left)},
              {"lost_area_m2", report.lost.area_m2},
              {"lost_share", report.lost.share}}
      .dump();
}

std::string boundarySection(const FinishOptions& options, const FinishReport& report, const Grid& grid) {
  Json section = Json::object();
  for (const BoundaryRole role : kBoundaryRoles) {
    const auto isOfRole = [role](const Boundary& boundary) { return boundary.role == role; };
    section[std::string(toString(role))] = std::ranges::count_if(grid.boundaries, isOfRole);
  }
  if (options.boundaries.any()) {
    section["edges_by_file"] = report.boundaries.edges_by_file;
    section["edges_told"] = report.boundaries.edges_by_file;  // the former name, for one more version
    section["edges_by_depth"] = report.boundaries.edges_by_depth;
    section["merged"] = report.boundaries.merged;
  }
  return section.dump();
}

std::string fieldSection(const FinishReport& report) {
  Json section = Json::array();
  for (const FieldReport& field : report.fields) {
    Json files = Json::array();
    for (std::size_t i = 0; i < field.rasters.size(); ++i)
      files.push_back({{"file", field.rasters[i].file},
                       {"table", field.rasters[i].table.empty() ? Json(nullptr) : Json(field.rasters[i].table)},
                       {"nodes", field.nodes_of_file[i]}});
    section.push_back({{"name", field.name},
                       {"files", std::move(files)},
                       {"notes", field.notes},
                       {"averaged", field.averaged},
                       {"of_number", field.of_number},
                       {"kept", field.kept},
                       {"filled", field.filled},
                       {"unknown", field.unknown},
                       {"least", field.least},
                       {"greatest", field.greatest}});
  }
  return section.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string depthSection(const FinishOptions& options, const FinishReport& report) {
  if (options.depth.files.empty()) return "null";
  const DepthReport& depth = report.depth;
  Json files = Json::array();
  for (std::size_t i = 0; i < depth.nodes_of_file.size(); ++i)
    files.push_back({{"file", options.depth.files[i]}, {"nodes", depth.nodes_of_file[i]}});
  return Json{{"method", kDepthMethodNames[static_cast<std::size_t>(options.depth.method)]},
              {"positive", options.depth.positive_down ? "down" : "up"},
              {"files", std::move(files)},
              {"notes", depth.notes},
              {"averaged", depth.averaged},
              {"partial", depth.partial},
              {"filled", depth.filled},
              {"unknown", depth.unknown},
              {"lowered", depth.lowered},
              {"above_water", depth.above_water},
              {"least_m", depth.least_m},
              {"greatest_m", depth.greatest_m}}
      .dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace coastmesh
