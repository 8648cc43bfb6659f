#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <tuple>

#include "apps/cli/commands.hpp"
#include "apps/cli/mesh_file.hpp"
#include "apps/cli/run_outputs.hpp"
#include "apps/job/check_grid.hpp"
#include "apps/process/exit_codes.hpp"
#include "apps/report/report_sections.hpp"
#include "apps/report/vector_output.hpp"
#include "apps/usage/input_usage.hpp"
#include "apps/usage/target_usage.hpp"
#include "gis/check/check_segments.hpp"
#include "gis/check/check_target.hpp"
#include "gis/check/node_meets.hpp"
#include "gis/check/triangle_overlaps.hpp"
#include "gis/elements/elements.hpp"
#include "gis/elements/quads.hpp"
#include "gis/error.hpp"
#include "gis/for_count.hpp"
#include "gis/format/grid_io.hpp"
#include "gis/grid/ground_orientation.hpp"
#include "gis/grid/linked_grid.hpp"
#include "gis/grid/one_turn.hpp"
#include "gis/mesh_layers.hpp"
#include "gis/model/apart_waters.hpp"
#include "gis/model/impossible_depths.hpp"
#include "gis/model/time_step.hpp"
#include "gis/places.hpp"
#include "parallel/recorder.hpp"
#include "parallel/workers.hpp"

namespace coastmesh {

namespace {

constexpr std::size_t kPlacesShown = 5;

struct CheckUsage {
  MeshFile mesh;
  InputOptions input;
  GridCheckOptions check;
  std::vector<std::string> targets;
  TargetCheckOptions target_check;
  std::string output;
  bool overwrite = false;
  bool quiet = false;
};

// A defect as it is reported, whichever check found it.
struct DefectRow {
  std::string kind;
  std::string target;  // the model that it matters to; empty: any
  Point place;
  std::int64_t triangle = -1;
  std::int64_t node = -1;
  double value = 0.0;
  std::string detail;
  bool advice = false;
};

DefectRow rowOf(const GridDefect& defect) {
  DefectRow row{std::string(toString(defect.kind)), {}, defect.place, defect.triangle, -1, defect.value, {}};
  if (defect.kind == DefectKind::AngleBelowBound) {
    char text[40];
    std::snprintf(text, sizeof text, "%.3f degrees", defect.value);
    row.detail = text;
  }
  return row;
}

DefectRow rowOf(const ApartWater& water, const Grid& grid) {
  DefectRow row{
      "water apart", {}, middleOf(grid, water.triangle), water.triangle, -1, static_cast<double>(water.triangles), {}};
  row.detail = std::to_string(water.triangles) + forCount(water.triangles, " triangle", " triangles") +
               " without a connection to an open boundary";
  return row;
}

DefectRow rowOf(const TargetDefect& defect, const std::string& target) {
  DefectRow row{std::string(toString(defect.kind)),
                target,
                defect.place,
                defect.triangle,
                defect.node,
                defect.value,
                defect.text,
                defect.advice};
  if (row.detail.empty() && defect.value != 0.0) {
    char text[40];
    std::snprintf(text, sizeof text, "%.6g", defect.value);
    row.detail = text;
  }
  return row;
}

// Quadrilaterals with an angle of 180 degrees or more.
std::vector<DefectRow> bentRows(const Grid& grid) {
  std::vector<DefectRow> rows;
  for (const Quad& quad : quadsOf(grid)) {
    const double greatest = std::ranges::max(anglesOf(grid, quad));
    if (greatest < 180.0) continue;
    char text[40];
    std::snprintf(text, sizeof text, "%.3f degrees", greatest);
    rows.push_back(
        {"quadrilateral not convex", {}, middleOf(grid, quad.halves[0]), quad.halves[0], -1, greatest, text});
  }
  return rows;
}

// Triangles as the file numbers its elements.
void useElementNumbers(const Grid& grid, std::vector<DefectRow>& rows) {
  const Elements elements(grid);
  for (DefectRow& row : rows)
    if (row.triangle >= 0) row.triangle = elements.elementOf(static_cast<std::uint32_t>(row.triangle));
}

// Where triangles meet without being connected: overlaps and, `with_nodes`, repeated and hanging nodes, which
// `checkTarget` reports for models. Nodes of weirs are exempt: both sides may coincide.
std::vector<DefectRow> meetingRows(const Grid& grid, const TriMesh& mesh, bool with_nodes, const ItemLoop& loop) {
  std::vector<DefectRow> rows;
  const Elements elements(grid);
  for (const auto& [t, other] : triangleOverlaps(grid, mesh, loop))
    rows.push_back({std::string(toString(TargetDefectKind::Overlap)),
                    {},
                    middleOf(grid, t),
                    t,
                    -1,
                    0.0,
                    "with triangle " + std::to_string(elements.elementOf(other) + 1)});
  if (!with_nodes) return rows;
  std::vector<bool> of_weir(grid.nodes.size(), false);
  for (const Boundary& boundary : grid.boundaries)
    for (std::size_t i = 0; i < boundary.back_nodes.size(); ++i)
      of_weir[boundary.nodes[i]] = of_weir[boundary.back_nodes[i]] = true;
  const auto add = [&](TargetDefectKind kind, const std::vector<std::uint32_t>& nodes) {
    for (const std::uint32_t node : nodes)
      if (!of_weir[node]) rows.push_back({std::string(toString(kind)), {}, grid.nodes[node], -1, node, 0.0, {}});
  };
  add(TargetDefectKind::RepeatedNode, repeatedNodes(grid, loop));
  add(TargetDefectKind::HangingNode, hangingNodes(grid, mesh, loop));
  return rows;
}

// What any reader of the file may stumble over: boundaries that are not those of the mesh, and nodes without triangles.
// Only models' formats with segments of nodes list all of the boundary.
std::vector<DefectRow> fileRows(const Grid& grid, const TriMesh& mesh, const std::string& path, const ItemLoop& loop) {
  std::vector<DefectRow> rows;
  const GridFormat* const format = gridFormatOf(path);
  const bool lists_all = format != nullptr && (format->name == "adcirc" || format->name == "schism");
  if (!grid.boundaries.empty()) {
    for (const TargetDefect& defect : checkSegments(grid, mesh, boundaryEdges(mesh, loop), std::nullopt, loop))
      if (lists_all || defect.kind != TargetDefectKind::NoBoundary) rows.push_back(rowOf(defect, {}));
  }
  std::vector<bool> is_used(grid.nodes.size(), false);
  for (const auto& triangle : grid.triangles)
    for (const std::uint32_t node : triangle) is_used[node] = true;
  for (std::uint32_t node = 0; node < is_used.size(); ++node)
    if (!is_used[node])
      rows.push_back(
          {std::string(toString(TargetDefectKind::UnusedNode)), {}, grid.nodes[node], -1, node, 0.0, {}, true});
  std::ranges::stable_sort(rows, {}, &DefectRow::kind);
  return rows;
}

// Advice if the time step holds for the still water, but not with the water over most of a flood plain.
void adviseOfFlood(const Grid& grid, double time_step_s, std::vector<DefectRow>& rows, const ItemLoop& loop) {
  const StepReport step = measureStep(grid, loop);
  if (step.flood_m <= 0.0 || step.flooded_step_s >= time_step_s || step.step_s < time_step_s) return;
  const double courant = time_step_s / step.flooded_step_s;
  rows.push_back({"courant when flooded",
                  {},
                  step.flooded_place,
                  -1,
                  -1,
                  courant,
                  amount("%.3g", courant) +
                      amount(" with the water %.3g m higher, over most of the land: ", step.flood_m) + "at most " +
                      atMost(step.flooded_step_s) + " s",
                  true});
}

bool isDefect(const DefectRow& row) { return !row.advice; }

void printDefects(const CheckUsage& usage, const Grid& grid, const BoundCounts& bounds,
                  const std::vector<DefectRow>& defects) {
  const auto found = std::ranges::count_if(defects, isDefect);
  const char* const element = quadsOf(grid).empty() ? "triangle" : "element";
  std::printf("%s: %zu nodes, %s, %td %s\n", usage.mesh.path.c_str(), grid.nodes.size(), elementCount(grid).c_str(),
              found, forCount(found, "defect", "defects"));
  if (bounds.excused() > 0) std::printf("%s\n", boundText(bounds).c_str());
  for (std::size_t begin = 0, end = 0; begin < defects.size(); begin = end) {
    const DefectRow& first = defects[begin];
    const auto group = [](const DefectRow& row) { return std::tie(row.kind, row.target, row.advice); };
    for (end = begin; end < defects.size() && group(defects[end]) == group(first);) ++end;
    std::printf("%s%s%s%s: %zu\n", first.target.c_str(), first.target.empty() ? "" : ": ",
                first.advice ? "advice, " : "", first.kind.c_str(), end - begin);
    for (std::size_t i = begin; i < std::min(begin + kPlacesShown, end); ++i) {
      std::printf("  at %s", pointText(defects[i].place).c_str());
      if (defects[i].triangle >= 0) std::printf(", %s %lld", element, static_cast<long long>(defects[i].triangle + 1));
      if (defects[i].node >= 0) std::printf(", node %lld", static_cast<long long>(defects[i].node + 1));
      if (!defects[i].detail.empty()) std::printf(", %s", defects[i].detail.c_str());
      std::printf("\n");
    }
    if (end - begin > kPlacesShown) std::printf("  and %zu more\n", end - begin - kPlacesShown);
  }
}

VectorLayer layerOf(const std::vector<DefectRow>& defects) {
  const auto numberOf = [](std::int64_t index) { return index < 0 ? std::int64_t{-1} : index + 1; };
  VectorLayer layer;
  layer.name = kDefectLayer;
  layer.fields = {{"kind", std::string()},   {"triangle", std::int64_t{}}, {"value", 0.0},
                  {"node", std::int64_t{}},  {"target", std::string()},    {"detail", std::string()},
                  {"advice", std::int64_t{}}};
  for (const DefectRow& defect : defects)
    layer.shapes.push_back({{defect.place},
                            {defect.kind, numberOf(defect.triangle), defect.value, numberOf(defect.node), defect.target,
                             defect.detail, std::int64_t{defect.advice}}});
  return layer;
}

// Formats of models are checked as models read them. In other formats longitudes may jump at 180°: conversion unwraps
// them into one turn, and so does this check. The grid is restored at the end.
std::vector<DefectRow> targetRows(Grid& grid, const std::vector<Target>& targets, const CheckUsage& usage,
                                  const ItemLoop& loop) {
  std::vector<DefectRow> rows;
  if (targets.empty()) return rows;
  const GridFormat* const format = gridFormatOf(usage.mesh.path);
  TargetCheckOptions check = usage.target_check;
  check.overlaps = false;  // reported for any model
  std::optional<TurnedNodes> turned;
  if (format != nullptr && format->places != NodePlaces::OneTurn) turned.emplace(grid);
  const LinkedGrid linked = linkGrid(grid, loop);
  for (const Target target : targets) {
    for (const TargetDefect& defect : checkTarget(grid, linked, target, check, loop)) {
      DefectRow& row = rows.emplace_back(rowOf(defect, kTargetNames[static_cast<std::size_t>(target)]));
      if (turned) row.place = turned->putBack(row.place);
    }
  }
  if (turned) turned->putBack(grid);
  return rows;
}

void requireDepths(const Grid& grid, const CheckUsage& usage) {
  if (usage.target_check.time_step_s <= 0.0 || std::ranges::any_of(grid.z, [](double z) { return z < 0.0; })) return;
  throw InputError("--time-step needs depths: no node of '" + usage.mesh.path +
                   "' is known to be below the water; 'coastmesh convert --bathymetry' gives it depths");
}

int runCheck(const CheckUsage& usage, Run& run) {
  Interrupt& interrupt = run.interrupt;
  RunOutputs outputs(usage.overwrite, run.inputs, interrupt);
  StagedFiles* layer = nullptr;
  if (!usage.output.empty()) {
    requireVectorFormat(usage.output, 1);
    layer = &outputs.addFile(usage.output);
  }
  const std::vector<Target> targets = targetsNamed(usage.targets);
  Grid grid = readMeshFile(usage.mesh, run, targets.empty() ? FileNotes::Warnings : FileNotes::Defects);
  requireDepths(grid, usage);
  interrupt.check();
  GridCheckOptions options = usage.check;
  if (!usage.input.files.empty()) options.delaunay = true;
  InputOptions input = usage.input;
  chooseSurface(usage.targets, input.surface);
  options.surface = input.surface;
  GridCheck check;
  std::vector<DefectRow> rows;
  withThreads({}, [&] {
    Recorder recorder;
    const ItemLoop loop = recorder.loop("check", {[&interrupt] { return interrupt.requested(); }, {}});
    check = input.files.empty() ? checkGrid(grid, options, loop)
                                : checkGridAgainst(grid, JobInput(input, loop), options, loop);
    for (const GridDefect& defect : check.defects) rows.push_back(rowOf(defect));
    for (DefectRow& row : bentRows(grid)) rows.push_back(std::move(row));
    const TriMesh mesh = linkGrid(grid, loop).mesh;
    for (DefectRow& row : meetingRows(grid, mesh, targets.empty(), loop)) rows.push_back(std::move(row));
    for (DefectRow& row : targetRows(grid, targets, usage, loop)) rows.push_back(std::move(row));
    if (targets.empty())
      for (DefectRow& row : fileRows(grid, mesh, usage.mesh.path, loop)) rows.push_back(std::move(row));
    if (!targets.empty())
      for (const ApartWater& water : apartWaters(grid, loop)) rows.push_back(rowOf(water, grid));
    if (targets.empty() && usage.target_check.time_step_s > 0.0)
      for (const TargetDefect& defect : checkTimeStep(grid, usage.target_check.time_step_s, loop))
        rows.push_back(rowOf(defect, {}));
    if (usage.target_check.time_step_s > 0.0 && (targets.empty() || std::ranges::any_of(targets, isOfLongWaves)))
      adviseOfFlood(grid, usage.target_check.time_step_s, rows, loop);
  });
  useElementNumbers(grid, rows);
  // Advice for all models comes after all defects.
  std::ranges::stable_partition(rows, isDefect);
  if (layer != nullptr) {
    layer->make([&](const std::string& path) { writeVectorLayers(path, grid.crs, {layerOf(rows)}); });
  }
  outputs.commit();
  if (const auto impossible = impossibleDepths(grid))
    run.warn(textOf(*impossible, grid) + ": they stand for places without a depth, or are wrong");
  if (!usage.quiet) printDefects(usage, grid, check.bounds, rows);
  return std::ranges::any_of(rows, isDefect) ? kExitShort : kExitDone;
}

}  // namespace

Command declareCheck(CLI::App& root) {
  auto usage = std::make_shared<CheckUsage>();
  OptionTable table = commandOptions("check", "Look for defects in a mesh; exit code 1 if there are any");
  declareMeshFile(table, "MESH", "mesh to check", usage->mesh);
  table.section(Section::Input);
  table.texts({"--input", "Input of the mesh"}, usage->input.files, kVectorFile, false,
              "what the mesh was made from; its points and edges must be in the mesh; can be repeated");
  declareTargets(table, usage->targets, "also look for what the model would reject; can be repeated");
  table.section(Section::Sizes);
  table
      .number({"--time-step", "Time step"}, usage->target_check.time_step_s, "S", {0.0, 1e6},
              "also look for triangles whose Courant number with this time step is above 1, or the limit of --target, "
              "which fesom, mpas and swan do not have; 0: no such test")
      .needs(
          [usage] {
            const std::vector<Target> targets = targetsNamed(usage->targets);
            return targets.empty() || std::ranges::any_of(targets, isOfLongWaves);
          },
          "if --target is fesom, mpas or swan alone, which have no limit for it");
  table.section(Section::Triangles);
  table.number({"--min-angle", "Minimum angle"}, usage->check.min_angle_deg, "DEG", {0.0, 60.0},
               "minimum angle of the triangles");
  table.number({"--max-angle", "Maximum angle"}, usage->check.max_angle_deg, "DEG", {60.0, 180.0},
               "maximum angle of the triangles");
  declareSurface(table, usage->input.surface);
  table.section(Section::Triangles);
  table.flag({"--delaunay", "Look for edges that are not Delaunay"}, usage->check.delaunay,
             "look for edges that are not Delaunay too; always done with --input; without it, constraints inside the "
             "mesh are unknown and may be reported");
  table.flag({"--pinches", "Look for nodes where the mesh touches itself"}, usage->check.pinches,
             "look for nodes where the mesh touches itself too");
  table.needing({"--input"}, [&] {
    declareInputOptions(table, usage->input);
    declarePinches(table, {"--input-pinches", "Pinches of the input"},
                   "value of --pinches with which the mesh was made from --input", usage->input);
  });
  table.section(Section::Output);
  table.output({"-o,--output", "Defects"}, usage->output, {},
               "write the defects as a layer of points: .gpkg, .geojson or .fgb");
  table.flag({"--overwrite", "Replace files"}, usage->overwrite, "replace a file that exists").needs({"--output"});
  table.section(Section::Run);
  table.flag({"--quiet", "No summary"}, usage->quiet, "print nothing");
  table.example("coastmesh check lake.nc --input lake.geojson --min-angle 33",
                "is the mesh valid, does it meet the angle, is all of the input in it?");
  table.example("coastmesh check grid.2dm -o defects.gpkg", "the defects as a layer of points");
  return {{root, std::move(table)}, [usage](Run& run) { return runCheck(*usage, run); }};
}

}  // namespace coastmesh
