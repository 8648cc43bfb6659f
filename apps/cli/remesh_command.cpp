#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>

#include "apps/cli/commands.hpp"
#include "apps/cli/mesh_edit.hpp"
#include "apps/job/places.hpp"
#include "apps/remesh/remesh_grid.hpp"
#include "apps/report/remesh_texts.hpp"
#include "apps/report/report_sections.hpp"
#include "apps/usage/finish_usage.hpp"
#include "apps/usage/part_usage.hpp"
#include "apps/usage/sizing_usage.hpp"
#include "gis/cut/number_table.hpp"
#include "gis/error.hpp"
#include "gis/for_count.hpp"

namespace coastmesh {

namespace {

struct RemeshUsage {
  MeshFile mesh;
  PartUsage part;
  RemeshOptions remesh;
  SizingUsage sizing;
};

const std::string kPurpose = "to mesh anew";

void requirePossible(const RemeshUsage& usage) {
  requirePart(usage.part, kPurpose);
  const SizeOptions& sizes = usage.remesh.sizes;
  if (!sizes.any() && !std::isfinite(sizes.most_m))
    throw OptionError("nothing says how large the new triangles should be: give --size, or others");
}

std::vector<std::string> warningsOf(const RemeshReport& report, const RemeshUsage& usage, const Grid& grid) {
  constexpr double kMostly = 0.5;
  std::vector<std::string> all;
  if (report.rim.share > kMostly)
    all.push_back("sizes differ from those asked for in " + amount("%.0f", 100.0 * report.rim.share) +
                  " % of the part, as they have to join those of the triangles around it" +
                  (report.rim.width_m > 0.0 ? ", over up to " + lengthText(report.rim.width_m, grid) : "") +
                  ": a larger part or a larger --grade leaves more room");
  if (!report.has_shore)
    all.emplace_back("--size-shore has no effect: the mesh has no shore near the part that is meshed anew");
  if (report.replaced.partition_dropped)
    all.emplace_back("the assignment to processes is of the mesh before, and left out; partition makes a new one");
  std::ranges::move(newNodeWarnings(report, usage.remesh.depth), std::back_inserter(all));
  return all;
}

std::string textOf(const RemeshReport& report, const RemeshUsage& usage, const Grid& grid) {
  const ReplaceReport& replaced = report.replaced;
  std::string text =
      grouped(replaced.triangles_removed) + " of " + grouped(replaced.triangles_before) + " triangles replaced by " +
      grouped(replaced.triangles_added) + ", " + grouped(replaced.nodes_removed) + " of " +
      grouped(replaced.nodes_before) + " nodes by " + grouped(replaced.nodes_added) +
      (report.patches > 1 ? ", in " + grouped(report.patches) + " parts without a common edge" : "") + "\n";
  text += "new: " + figuresText(report.inside, grid);
  if (report.outside.triangles > 0) text += "unchanged: " + figuresText(report.outside, grid);
  if (replaced.boundary_nodes + replaced.line_nodes > 0)
    text += "nodes added to boundaries: " + grouped(replaced.boundary_nodes) +
            ", to lines: " + grouped(replaced.line_nodes) + "\n";
  if (report.whole_edges > 0) text += "edges of weirs that stay in the part: " + grouped(report.whole_edges) + "\n";
  if (report.rim.width_m > 0.0)
    text += "sizes change from those around to those asked for over up to " + lengthText(report.rim.width_m, grid) +
            "; in " + amount("%.0f", 100.0 * report.rim.share) + " % of the part they differ from those asked for\n";
  const auto [loose, teeth] = report.tidied;
  if (loose + teeth > 0)
    text += "kept at the edge of the part: " + grouped(teeth) + forCount(teeth, " triangle", " triangles") +
            " with two sides along it or without a neighbour, " + grouped(loose) +
            " that only a node connects to the others\n";
  if (report.taken_in > 0)
    text += "replaced beside the part: " + grouped(report.taken_in) +
            forCount(report.taken_in, " triangle", " triangles") + ", within it or for the sake of angles\n";
  if (!usage.remesh.depth.files.empty())
    text += "new nodes without a value in any raster, which keep the depth of the mesh before: " +
            grouped(report.depth.kept) + "\n";
  return text;
}

int runRemesh(RemeshUsage& usage, Run& run) {
  requirePossible(usage);
  RemeshOptions& options = usage.remesh;
  settleSizing(usage.sizing, options.depth, SizeChoice::None, options.sizes);
  for (const std::string& note : notesOnOverriddenSizes(usage.sizing, options.sizes)) run.warn(note);
  RemeshReport report;
  const auto remesh = [&](Grid& grid, const RunControl& control, const ItemLoop& loop) {
    MeshEdit edit;
    report = remeshGrid(grid, requireTriangles(usage.part, grid, usage.mesh.path, kPurpose, edit.warnings, loop),
                        options, control, loop);
    std::ranges::move(warningsOf(report, usage, grid), std::back_inserter(edit.warnings));
    edit.text = [&](const Grid& finished) { return textOf(report, usage, finished); };
    edit.writeNumbers = [&](const std::string& path, const ItemLoop& write) {
      writeNumberTable(report.replaced.nodes, report.replaced.triangles, path, write);
    };
    return edit;
  };
  return runMeshEdit("remesh", usage.mesh, usage.part, remesh, run);
}

}  // namespace

Command declareRemesh(CLI::App& root) {
  auto usage = std::make_shared<RemeshUsage>();
  OptionTable table = commandOptions("remesh", "Mesh a part of a mesh anew, with other sizes");
  declareMeshFile(table, "MESH", "mesh to read", usage->mesh);
  const PartHelp part{
      "replace", "keep, except for a few at the edge of the part that angles need,",
      "repair what the model would reject, in all of the mesh, and report each repair; can be repeated",
      "Numbers in the mesh before",
      "write a table (CSV) with the number that each node and triangle had in MESH, nothing for new ones"};
  declarePart(table, usage->part, part);
  RefineOptions& refine = usage->remesh.mesh.refine;
  table.section(Section::Triangles);
  table.number({"--min-angle", "Minimum angle"}, refine.min_angle_deg, "DEG", {0.0, 45.0},
               "minimum angle of the new triangles");
  table.number({"--max-angle", "Maximum angle"}, refine.max_angle_deg, "DEG", {60.0, 180.0},
               "maximum angle of the new triangles; 180: no limit");
  const SizeHelp help{"no size is smaller, except where triangles around the part are",
                      "no size is larger, except where triangles around the part are",
                      "no element is smaller than --courant allows for this time step, except where triangles around "
                      "the part are; 0: not used"};
  declareSizes(table, usage->remesh.sizes, usage->sizing, help, [] { return SizeChoice::None; });
  declareDepths(table, usage->remesh.depth,
                "raster with the depths of new nodes; can be repeated, the first with a value at a node is used; "
                "without one, depths are linear between nodes of MESH");
  declarePartOutputs(table, usage->part, part);
  table.example("coastmesh remesh fort.14 -o finer.14 --bbox=-91,46.5,-90,47 --size 500 --assume-crs EPSG:4326",
                "triangles of 500 m in a box");
  table.example("coastmesh remesh hgrid.gr3 -o finer.gr3 --within bay.geojson --size-shore 500 --size-max 5000",
                "a bay with a finer shore");
  return {{root, std::move(table)}, [usage](Run& run) { return runRemesh(*usage, run); }};
}

}  // namespace coastmesh
