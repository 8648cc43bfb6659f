#include <cstdio>
#include <memory>

#include "apps/cli/commands.hpp"
#include "apps/cli/exit_codes.hpp"
#include "apps/cli/mesh_file.hpp"
#include "apps/cli/run_outputs.hpp"
#include "apps/job/finish_grid.hpp"
#include "apps/report/report_sections.hpp"
#include "apps/usage/grid_usage.hpp"
#include "apps/usage/input_usage.hpp"
#include "apps/usage/target_usage.hpp"
#include "gis/coast/box_of_frame.hpp"
#include "gis/cut/cut_grid.hpp"
#include "gis/cut/cut_region.hpp"
#include "gis/cut/number_table.hpp"
#include "gis/error.hpp"
#include "gis/for_count.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "parallel/recorder.hpp"
#include "parallel/workers.hpp"

namespace coastmesh {

namespace {

struct CutUsage {
  MeshFile mesh;
  CutRegion region;
  CutOptions cut;
  std::vector<std::string> outputs;
  std::string format;
  std::string numbers;
  FinishOptions finish;
  bool overwrite = false;
  bool quiet = false;
};

void requirePossible(const CutUsage& usage) {
  if (!usage.region.any())
    throw OptionError("nothing says which part of the mesh to cut out: give --bbox, --within or --outside");
  if (!usage.numbers.empty() && !usage.finish.targets.empty())
    throw OptionError(
        "--numbers: repairs for --target add, move and remove nodes, so that numbers are no longer those of the mesh; "
        "leave --target out, and repair with convert --target if check finds anything");
}

[[noreturn]] void refuseEmpty(const CutUsage& usage, const Grid& grid) {
  throw InputError("no triangle of '" + usage.mesh.path +
                   "' has its middle in the part to cut out; the mesh extends, as W,S,E,N, over " +
                   inWords(boxAround(grid.nodes, inOrder)) + (grid.crs.isPlane() ? "" : " (" + nameOf(grid.crs) + ")"));
}

std::vector<std::string> warningsOf(const CutReport& report) {
  std::vector<std::string> all;
  const auto add = [&](std::size_t count, const char* one, const char* many) {
    if (count > 0) all.push_back(grouped(count) + forCount(count, one, many));
  };
  add(report.stray_edges, " edge of the boundaries is not where the mesh ends, and is left out; check finds it",
      " edges of the boundaries are not where the mesh ends, and are left out; check finds them");
  add(report.walls, " shore of a weir has lost the shore across, and is land now",
      " shores of weirs have lost the shore across, and are land now");
  if (report.partition_dropped)
    all.emplace_back("the assignment to processes is of the whole mesh, and left out; partition makes a new one");
  return all;
}

std::string textOf(const CutReport& report, const CutUsage& usage) {
  std::string text =
      grouped(report.triangles.size()) + " of " + grouped(report.triangles_before) + " triangles, " +
      grouped(report.nodes.size()) + " of " + grouped(report.nodes_before) + " nodes; " +
      grouped(report.boundaries_kept) +
      forCount(report.boundaries_kept, " boundary or part of one kept, ", " boundaries or parts of them kept, ") +
      grouped(report.boundaries_cut) + " along the cut\n";
  const auto [loose, teeth] = report.tidied;
  if (loose + teeth > 0)
    text += "left out at the cut: " + grouped(teeth) + forCount(teeth, " triangle", " triangles") +
            " with two sides along it or without a neighbour, " + grouped(loose) +
            " that only a node would connect to the others\n";
  if (report.waters > 1)
    text += grouped(report.waters) + " waters without a connection" +
            (usage.cut.largest_water ? ": only the largest is kept\n" : "; --keep-water largest keeps one\n");
  return text;
}

int runCut(const CutUsage& usage, Run& run) {
  requirePossible(usage);
  Interrupt& interrupt = run.interrupt;
  RunOutputs outputs(usage.overwrite, run.inputs, interrupt);
  outputs.addGrids(usage.outputs, usage.format);
  StagedFiles* const numbers = usage.numbers.empty() ? nullptr : &outputs.addFile(usage.numbers);
  Grid grid = readMeshFile(usage.mesh, run);
  findMissingBoundaries(grid);
  const RunControl control{[&interrupt] { return interrupt.requested(); }, {}};
  CutReport report;
  FinishReport finish;
  std::vector<std::string> warnings;
  withThreads({}, [&] {
    Recorder recorder;
    const ItemLoop loop = recorder.loop("cut", control);
    std::vector<std::uint8_t> taken = trianglesIn(usage.region, grid, warnings, loop);
    if (std::ranges::find(taken, 1) == taken.end()) refuseEmpty(usage, grid);
    report = cutGrid(grid, std::move(taken), usage.cut, loop);
    finish = finishGrid(grid, usage.finish, control, loop);
    if (usage.finish.targets.empty()) warnings.push_back(windingWarning(grid, loop));
  });
  for (const auto& some : {warnings, warningsOf(report), finish.warnings(), outputs.numberWarnings(grid),
                           outputs.lossWarnings(grid, LossesOf::Grid)})
    for (const std::string& warning : some)
      if (!warning.empty()) run.warn(warning);
  withThreads({}, [&] {
    Recorder recorder;
    for (std::size_t i = 0; i < outputs.grids(); ++i) {
      interrupt.check();
      outputs.writeGrid(i, grid, recorder.loop("write", control));
    }
    if (numbers != nullptr)
      numbers->make([&](const std::string& path) {
        writeNumberTable(report.nodes, report.triangles, path, recorder.loop("write", control));
      });
  });
  outputs.commit();
  if (!usage.quiet) std::fputs((textOf(report, usage) + finishSummary(usage.finish, finish)).c_str(), stdout);
  return finish.repairs.left.empty() ? kExitDone : kExitShort;
}

}  // namespace

Command declareCut(CLI::App& root) {
  auto usage = std::make_shared<CutUsage>();
  OptionTable table = commandOptions("cut", "Cut out a part of a mesh");
  declareMeshFile(table, "MESH", "mesh to read", usage->mesh);
  CutRegion& region = usage->region;
  table.section(Section::Domain);
  table.numbers(
      {"--bbox", "Bounding box"}, "W,S,E,N", false,
      [&region](const std::vector<double>& sides) { return storeBox(sides, region.box); },
      "keep only triangles whose middle is in this box, in the mesh's CRS; in degrees, a box with E less than W "
      "crosses the antimeridian");
  table.texts({"--within", "Within polygons"}, region.within, kVectorFile, false,
              "keep only triangles whose middle is in a polygon of this file, in any CRS; can be repeated");
  table.texts({"--outside", "Outside polygons"}, region.outside, kVectorFile, false,
              "leave out triangles whose middle is in a polygon of this file; can be repeated");
  table.choice(
      {"--keep-water", "Waters to keep"}, "all", {"largest", "all"},
      [&cut = usage->cut](const std::string& chosen) { cut.largest_water = chosen == "largest"; },
      "which parts of the water to keep if the cut divides it");
  table.section(Section::Boundaries);
  table.choice(
      {"--cut-boundary", "Type of the cut"}, "open", {"open", "land"},
      [&cut = usage->cut](const std::string& chosen) {
        cut.cut_role = chosen == "land" ? BoundaryRole::Land : BoundaryRole::Open;
      },
      "type of the boundaries along the cut; all others keep theirs");
  declareTargets(table, usage->finish.targets,
                 "repair what the model would reject, and report each repair; can be repeated");
  declareGridOutputs(table, usage->outputs, usage->format);
  table.output({"--numbers", "Numbers in the whole mesh"}, usage->numbers, {},
               "write a table (CSV) with the number that each node and triangle had in MESH, to cut out other files of "
               "the model");
  table.flag({"--overwrite", "Replace files"}, usage->overwrite, "replace files that exist");
  table.section(Section::Run);
  table.flag({"--quiet", "No summary"}, usage->quiet, "print no summary");
  table.example("coastmesh cut fort.14 -o bay.14 --bbox=-91,46.5,-90,47 --assume-crs EPSG:4326",
                "the part of a grid in a box");
  table.example("coastmesh cut hgrid.gr3 -o bay.gr3 --within bay.geojson --numbers numbers.csv",
                "the part in polygons, with the numbers that its nodes had");
  return {{root, std::move(table)}, [usage](Run& run) { return runCut(*usage, run); }};
}

}  // namespace coastmesh
