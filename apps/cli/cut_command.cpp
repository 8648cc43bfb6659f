#include <algorithm>
#include <iterator>
#include <memory>

#include "apps/cli/commands.hpp"
#include "apps/cli/mesh_edit.hpp"
#include "apps/report/report_sections.hpp"
#include "apps/usage/part_usage.hpp"
#include "gis/cut/cut_grid.hpp"
#include "gis/cut/number_table.hpp"
#include "gis/for_count.hpp"

namespace coastmesh {

namespace {

struct CutUsage {
  MeshFile mesh;
  PartUsage part;
  CutOptions cut;
};

const std::string kPurpose = "to cut out";

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
  requirePart(usage.part, kPurpose);
  CutReport report;
  const auto cut = [&](Grid& grid, const RunControl&, const ItemLoop& loop) {
    MeshEdit edit;
    report = cutGrid(grid, requireTriangles(usage.part, grid, usage.mesh.path, kPurpose, edit.warnings, loop),
                     usage.cut, loop);
    std::ranges::move(warningsOf(report), std::back_inserter(edit.warnings));
    edit.text = [&](const Grid&) { return textOf(report, usage); };
    edit.writeNumbers = [&](const std::string& path, const ItemLoop& write) {
      writeNumberTable(report.nodes, report.triangles, path, write);
    };
    return edit;
  };
  return runMeshEdit("cut", usage.mesh, usage.part, cut, run);
}

}  // namespace

Command declareCut(CLI::App& root) {
  auto usage = std::make_shared<CutUsage>();
  OptionTable table = commandOptions("cut", "Cut out a part of a mesh");
  declareMeshFile(table, "MESH", "mesh to read", usage->mesh);
  const PartHelp help{
      "keep", "leave out", "repair what the model would reject, and report each repair; can be repeated",
      "Numbers in the whole mesh",
      "write a table (CSV) with the number that each node and triangle had in MESH, to cut out other files of the "
      "model"};
  declarePart(table, usage->part, help);
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
  declarePartOutputs(table, usage->part, help);
  table.example("coastmesh cut fort.14 -o bay.14 --bbox=-91,46.5,-90,47 --assume-crs EPSG:4326",
                "the part of a grid in a box");
  table.example("coastmesh cut hgrid.gr3 -o bay.gr3 --within bay.geojson --numbers numbers.csv",
                "the part in polygons, with the numbers that its nodes had");
  return {{root, std::move(table)}, [usage](Run& run) { return runCut(*usage, run); }};
}

}  // namespace coastmesh
