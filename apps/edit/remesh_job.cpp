#include "apps/edit/remesh_job.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

#include "apps/edit/edit_part.hpp"
#include "apps/remesh/remesh_grid.hpp"
#include "apps/remesh/triangle_figures.hpp"
#include "apps/report/remesh_texts.hpp"
#include "apps/report/report_sections.hpp"
#include "gis/elements/quads.hpp"
#include "gis/for_count.hpp"
#include "gis/places.hpp"

namespace coastmesh {

namespace {

std::vector<std::string> warningsOf(const RemeshReport& report, const DepthOptions& depth, const Grid& grid) {
  constexpr double kMostly = 0.5;
  std::vector<std::string> all;
  if (report.rim.share > kMostly)
    all.push_back("sizes differ from those asked for in " + amount("%.0f", 100.0 * report.rim.share) +
                  " % of the part, as they have to join those of the triangles around it" +
                  (report.rim.width_m > 0.0 ? ", over up to " + lengthText(report.rim.width_m, grid) : "") +
                  ": a larger part or a larger --grade leaves more room");
  if (!report.has_shore)
    all.emplace_back("--size-shore has no effect: the mesh has no shore near the part that is meshed anew");
  if (report.land_unknown > 0)
    all.push_back(
        "--size-shore is for the outline of the mesh, and not for a coast within it: " + grouped(report.land_unknown) +
        forCount(report.land_unknown, " triangle that was replaced lies", " triangles that were replaced lie") +
        " above the water, and the mesh has no attribute flood_plain, which tells land from water. First "
        "give it that, with coastmesh convert --attribute flood_plain=FILE, or ask for sizes at the coast "
        "with --depth-band");
  if (report.replaced.partition_dropped)
    all.emplace_back("the assignment to processes is of the mesh before, and left out; partition makes a new one");
  std::ranges::move(newNodeWarnings(report, depth), std::back_inserter(all));
  return all;
}

std::string textOf(const RemeshReport& report, const TriangleFigures& inside, const TriangleFigures& outside,
                   const DepthOptions& depth, const Grid& grid) {
  const ReplaceReport& replaced = report.replaced;
  const std::size_t quads_replaced = report.quads_before - report.quads;
  std::string text =
      grouped(replaced.triangles_removed - 2 * quads_replaced) + " of " +
      grouped(replaced.triangles_before - 2 * report.quads_before) + " triangles " +
      (report.quads_before > 0
           ? "and " + grouped(quads_replaced) + " of " + grouped(report.quads_before) + " quadrilaterals "
           : "") +
      "replaced by " + grouped(replaced.triangles_added) + ", " + grouped(replaced.nodes_removed) + " of " +
      grouped(replaced.nodes_before) + " nodes by " + grouped(replaced.nodes_added) +
      (report.patches > 1 ? ", in " + grouped(report.patches) + " parts without a common edge" : "") + "\n";
  text += "new: " + figuresText(inside, grid);
  if (outside.triangles > 0) text += "unchanged: " + figuresText(outside, grid);
  if (replaced.boundary_nodes + replaced.line_nodes > 0)
    text += "nodes added to boundaries: " + grouped(replaced.boundary_nodes) +
            ", to lines: " + grouped(replaced.line_nodes) + "\n";
  if (report.whole_edges > 0) text += "edges of weirs that stay in the part: " + grouped(report.whole_edges) + "\n";
  if (report.rim.width_m > 0.0)
    text += "sizes change from those around to those asked for over up to " + lengthText(report.rim.width_m, grid) +
            "; in " + amount("%.0f", 100.0 * report.rim.share) + " % of the part they differ from those asked for\n";
  const auto [loose, teeth] = report.tidied;
  if (loose + teeth > 0)
    text += "kept at the edge of the part: " + grouped(teeth) +
            forCount(teeth, report.quads_before > 0 ? " element" : " triangle",
                     report.quads_before > 0 ? " elements" : " triangles") +
            " with two sides along it or without a neighbour, " + grouped(loose) +
            " that only a node connects to the others\n";
  if (report.taken_in > 0)
    text += "replaced beside the part: " + grouped(report.taken_in) +
            forCount(report.taken_in, " triangle", " triangles") + ", within it or for the sake of angles\n";
  if (!depth.files.empty())
    text += "new nodes without a value in any raster, which keep the depth of the mesh before: " +
            grouped(report.depth.kept) + "\n";
  return text;
}

}  // namespace

EditedMesh runRemeshJob(Grid& grid, const std::string& name, const RemeshJob& job, const JobControl& control) {
  const RefineOptions& bounds = job.remesh.mesh.refine;
  RepairedTriangles repaired;
  const auto remesh = [&](const RunControl& of_edit, const ItemLoop& loop) {
    MeshEdit edit;
    RemeshReport report =
        remeshGrid(grid, requireTriangles(job.region, grid, name, RemeshJob::kPurpose, edit.warnings, loop), job.remesh,
                   of_edit, loop);
    std::ranges::move(warningsOf(report, job.remesh.depth, grid), std::back_inserter(edit.warnings));
    edit.sources.nodes = std::move(report.replaced.nodes);
    edit.sources.triangles = std::move(report.replaced.triangles);
    const std::vector<std::uint32_t>& sources = edit.sources.triangles;
    const std::vector<std::uint32_t> other_half = otherHalves(grid);
    const bool may_change = job.finish.mayEdit();
    const LastingFigures inside(report.inside, may_change, grid, loop,
                                [&](std::size_t t) { return sources[t] == kNone; });
    const LastingFigures outside(report.outside, may_change, grid, loop, [&](std::size_t t) {
      return sources[t] != kNone && (other_half.empty() || other_half[t] == kNone);
    });
    const BeforeRepairs before(grid, may_change, loop);
    edit.text = [report = std::move(report), inside, outside, before, &job, &bounds, &repaired](const Grid& finished) {
      repaired = before.repairedIn(finished, bounds.min_angle_deg, bounds.max_angle_deg);
      return textOf(report, inside.in(finished), outside.in(finished), job.remesh.depth, finished) +
             repairedText(repaired, finished);
    };
    return edit;
  };
  EditedMesh edited = editMesh("remesh", grid, remesh, job.finish, control);
  if (repaired.below > 0) edited.warnings.push_back(repairedWarning(repaired));
  return edited;
}

}  // namespace coastmesh
