#include "apps/edit/rivers_job.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "apps/job/available_memory.hpp"
#include "apps/job/places.hpp"
#include "apps/report/remesh_texts.hpp"
#include "apps/report/report_sections.hpp"
#include "gis/elements/elements.hpp"
#include "gis/error.hpp"
#include "gis/for_count.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/model/fill_depths.hpp"

namespace coastmesh {

namespace {

constexpr double kBytesPerQuad = 1500.0;  // of the whole program
constexpr std::size_t kMostNamed = 5;     // lost rivers of one kind

std::vector<RiverLine> readLines(const std::vector<std::string>& paths, const Crs& crs, const RiversJob& job) {
  std::vector<RiverLine> lines;
  for (const std::string& path : paths)
    std::ranges::move(readRiverLines(path, crs, job.columns, job.width_m), std::back_inserter(lines));
  return lines;
}

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
  return "shorter than a row";
}

// A sentence for the rivers that are lost for one reason; empty if there are none.
std::string lostText(const std::vector<LostRiver>& all, RiverLoss why, const Grid& grid) {
  std::string places;
  std::size_t count = 0;
  for (const LostRiver& lost : all) {
    if (lost.why != why || ++count > kMostNamed) continue;
    if (!places.empty()) places += ", ";
    places += lost.name + " near " + pointText(lost.place);
    if (why == RiverLoss::Apart && std::isfinite(lost.distance) && lost.distance > 0.0)
      places += ", " + lengthText(lost.distance, grid) + " away";
  }
  if (count == 0) return {};
  if (count > kMostNamed) places += ", and more";
  return grouped(count) + forCount(count, " reach is", " reaches are") + " left out, " + whyText(why) + ": " + places;
}

std::vector<std::string> lostTexts(const RiverReport& report, const Grid& grid) {
  std::vector<std::string> texts;
  for (const RiverLoss why :
       {RiverLoss::Apart, RiverLoss::InWater, RiverLoss::Crowded, RiverLoss::Within, RiverLoss::Short})
    if (std::string text = lostText(report.lost, why, grid); !text.empty()) texts.push_back(std::move(text));
  return texts;
}

std::string joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : "; ") + text;
  return all;
}

// Of the lines, else of rasters, else of the mesh there; nodes without any get what their neighbours have.
std::string setRiverDepths(LaidRivers& laid, const Grid& mesh, const DepthOptions& options, const RunControl& control,
                           const ItemLoop& loop) {
  Grid& grid = laid.grid;
  const auto isKnown = [](double z) { return !std::isnan(z); };
  if (mesh.z.empty()) {
    const bool had_any = !options.files.empty() || std::ranges::any_of(grid.z, isKnown);
    grid.z.clear();
    return had_any ? "the mesh has no depths, and those of rivers are left out" : "";
  }
  const std::vector<double> of_lines = grid.z;
  if (!options.files.empty()) {
    DepthOptions of_rivers = options;
    of_rivers.fill = DepthFill::None;
    setDepths(grid, of_rivers, control, loop);
  }
  for (std::size_t i = 0; i < grid.z.size(); ++i) {
    if (isKnown(of_lines[i])) grid.z[i] = of_lines[i];
    if (!isKnown(grid.z[i])) grid.z[i] = laid.mesh_z[i];
  }
  fillFromNeighbours(grid, loop);
  const auto unknown = grid.z.size() - static_cast<std::size_t>(std::ranges::count_if(grid.z, isKnown));
  if (unknown == 0) return {};
  return grouped(unknown) + forCount(unknown, " node of rivers has", " nodes of rivers have") + " no depth";
}

// What could have joined the mesh, but has no water of it beside it, is land.
void closeBanks(Grid& grid, const std::vector<MergeSource>& nodes) {
  for (Boundary& boundary : grid.boundaries)
    if (boundary.role == BoundaryRole::Open &&
        std::ranges::all_of(boundary.nodes, [&](std::uint32_t node) { return nodes[node].mesh == 1; }))
      boundary.role = BoundaryRole::Land;
}

std::vector<std::uint32_t> numbersBefore(const std::vector<MergeSource>& sources) {
  std::vector<std::uint32_t> numbers;
  for (const MergeSource& source : sources) numbers.push_back(source.mesh == 0 ? source.number : kNone);
  return numbers;
}

std::string reportText(const RiverReport& report, const Grid& grid) {
  std::string text = "rivers: " + grouped(report.reaches) + forCount(report.reaches, " reach, ", " reaches, ") +
                     grouped(report.quads) + forCount(report.quads, " quadrilateral", " quadrilaterals");
  if (report.junctions > 0)
    text += ", " + grouped(report.triangles) + " triangles at " + grouped(report.junctions) +
            forCount(report.junctions, " junction", " junctions");
  text += ", " + grouped(report.inflows) + forCount(report.inflows, " river boundary", " river boundaries") + "\n";
  if (report.extended > 0)
    text += "continued to the water of the mesh: " + grouped(report.extended) +
            forCount(report.extended, " end", " ends") + "\n";
  if (report.moved_m > 0.0)
    text += "centre lines that turn too sharply for their width moved by at most " + lengthText(report.moved_m, grid) +
            ", near " + pointText(report.moved_place) + "\n";
  return text;
}

std::string narrowedText(const RiverReport& report) {
  if (report.narrowed == 0) return {};
  return grouped(report.narrowed) +
         forCount(report.narrowed, " reach comes closer to itself than its width, and is",
                  " reaches come closer to themselves than their width, and are") +
         " narrower there: near " + pointText(report.narrowed_place);
}

std::vector<std::string> mergeWarnings(const MergedMesh& merged, const DepthOptions& depth) {
  std::vector<std::string> all;
  if (merged.merged.cut_off > 0)
    all.push_back("rivers cut waters off from the rest, which are left out: " + grouped(merged.merged.cut_off) +
                  forCount(merged.merged.cut_off, " triangle", " triangles"));
  if (merged.merged.partition_dropped)
    all.emplace_back("the assignment to processes is of the mesh before, and left out; partition makes a new one");
  if (merged.band) std::ranges::move(newNodeWarnings(*merged.band, depth), std::back_inserter(all));
  return all;
}

MergedMesh putIn(Grid& grid, const std::string& name, Grid&& rivers, const MergeOptions& options,
                 const RunControl& control, const ItemLoop& loop) {
  try {
    MergedMesh merged = mergeMesh(grid, std::move(rivers), options, control, loop);
    closeBanks(grid, merged.nodes);
    return merged;
  } catch (const InputError& error) {
    throw InputError("the rivers cannot be added to '" + name + "': " + error.what());
  }
}

}  // namespace

EditedMesh runRiversJob(Grid& grid, const std::string& name, const std::vector<std::string>& lines,
                        const RiversJob& job, const Warn& warn, const JobControl& control) {
  const auto add = [&](const RunControl& of_edit, const ItemLoop& loop) {
    RiverOptions options = job.rivers;
    options.junctions = job.merge.mesh.refine;
    options.most_quads = std::min(options.most_quads, availableMemory() / kBytesPerQuad);
    LaidRivers laid = layRivers(readLines(lines, grid.crs, job), grid, options, of_edit, loop);
    const std::vector<std::string> lost = lostTexts(laid.report, grid);
    if (laid.grid.triangles.empty()) throw InputError("no river can be added to '" + name + "': " + joined(lost));
    for (const std::string& text : lost) warn(text);
    MeshEdit edit;
    edit.warnings = {narrowedText(laid.report), setRiverDepths(laid, grid, job.merge.depth, of_edit, loop)};
    const MergedMesh merged = putIn(grid, name, std::move(laid.grid), job.merge, of_edit, loop);
    std::ranges::move(mergeWarnings(merged, job.merge.depth), std::back_inserter(edit.warnings));
    std::string text = reportText(laid.report, grid);
    if (merged.band)
      text += "beside them: " + figuresText(merged.band->inside, grid) + "in place of " +
              grouped(merged.replaced + merged.merged.covered) + "\n";
    edit.sources.nodes = numbersBefore(merged.nodes);
    edit.sources.triangles = numbersBefore(merged.triangles);
    edit.text = [text](const Grid& finished) {
      return text + grouped(finished.nodes.size()) + " nodes, " + elementCount(finished, grouped) + "\n";
    };
    return edit;
  };
  return editMesh("rivers", grid, add, job.finish, control);
}

}  // namespace coastmesh
