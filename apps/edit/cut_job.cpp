#include "apps/edit/cut_job.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "apps/edit/edit_part.hpp"
#include "apps/report/report_sections.hpp"
#include "gis/elements/quads.hpp"
#include "gis/for_count.hpp"

namespace coastmesh {

namespace {

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

// `quads`: quadrilaterals, `quads_before` those of the whole grid.
std::string textOf(const CutReport& report, std::size_t quads, std::size_t quads_before, const CutOptions& options) {
  std::string text =
      grouped(report.triangles.size() - 2 * quads) + " of " + grouped(report.triangles_before - 2 * quads_before) +
      " triangles, " + (quads_before > 0 ? grouped(quads) + " of " + grouped(quads_before) + " quadrilaterals, " : "") +
      grouped(report.nodes.size()) + " of " + grouped(report.nodes_before) + " nodes; " +
      grouped(report.boundaries_kept) +
      forCount(report.boundaries_kept, " boundary or part of one kept, ", " boundaries or parts of them kept, ") +
      grouped(report.boundaries_cut) + " along the cut\n";
  const auto elements = [&](std::size_t count) {
    return grouped(count) +
           forCount(count, quads_before > 0 ? " element" : " triangle", quads_before > 0 ? " elements" : " triangles");
  };
  const auto [given, taken_in] = report.evened;
  if (given + taken_in > 0)
    text += "for an even edge of the cut: " + elements(given) + " left to the rest of the mesh, " + grouped(taken_in) +
            " of the rest taken in\n";
  const auto [loose, teeth] = report.tidied;
  if (loose + teeth > 0)
    text += "left out at the cut: " + elements(teeth) + " with two sides along it or without a neighbour, " +
            grouped(loose) + " that only a node would connect to the others\n";
  if (report.waters > 1)
    text += grouped(report.waters) + " waters without a connection" +
            (options.largest_water ? ": only the largest is kept\n" : "; --keep-water largest keeps one\n");
  return text;
}

}  // namespace

EditedMesh runCutJob(Grid& grid, const std::string& name, const CutJob& job, const JobControl& control) {
  const auto cut = [&](const RunControl&, const ItemLoop& loop) {
    MeshEdit edit;
    const std::size_t quads_before = quadsOf(grid).size();
    CutReport report =
        cutGrid(grid, requireTriangles(job.region, grid, name, CutJob::kPurpose, edit.warnings, loop), job.cut, loop);
    std::ranges::move(warningsOf(report), std::back_inserter(edit.warnings));
    edit.text = [text = textOf(report, quadsOf(grid).size(), quads_before, job.cut)](const Grid&) { return text; };
    edit.sources.nodes = std::move(report.nodes);
    edit.sources.triangles = std::move(report.triangles);
    return edit;
  };
  return editMesh("cut", grid, cut, job.finish, control);
}

}  // namespace coastmesh
