#include "apps/edit/rivers_job.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "apps/remesh/triangle_figures.hpp"
#include "apps/report/remesh_texts.hpp"
#include "apps/report/report_sections.hpp"
#include "apps/report/rivers_texts.hpp"
#include "gis/elements/elements.hpp"
#include "gis/error.hpp"
#include "gis/fields/node_fields.hpp"
#include "gis/fields/plain_field.hpp"
#include "gis/for_count.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/model/fill_depths.hpp"
#include "gis/places.hpp"
#include "gis/rivers/measure_rivers.hpp"
#include "gis/rivers/mesh_triangles.hpp"
#include "gis/rivers/river_banks.hpp"
#include "parallel/available_memory.hpp"

namespace coastmesh {

namespace {

constexpr double kBytesPerQuad = 1500.0;  // of the whole program

std::vector<RiverLine> readLines(const std::vector<std::string>& paths, const Crs& crs, const RiversJob& job) {
  constexpr double kFromBanks = std::numeric_limits<double>::quiet_NaN();
  const std::optional<double> usual_m = job.width_m || job.banks.empty() ? job.width_m : kFromBanks;
  std::vector<RiverLine> lines;
  for (const std::string& path : paths)
    std::ranges::move(readRiverLines(path, crs, job.columns, usual_m), std::back_inserter(lines));
  return lines;
}

// Lines as wide as the water between the banks; the result says in words how much of them is.
std::string takeWidths(std::vector<RiverLine>& lines, const std::vector<std::string>& files, const Grid& grid,
                       std::vector<std::string>& warnings, const ItemLoop& loop) {
  if (files.empty()) return {};
  RiverBanks banks;
  for (const std::string& file : files) readRiverBanks(file, grid.crs, banks, warnings);
  MeasuredRivers measured = measureRivers(std::move(lines), banks, grid.crs, loop);
  lines = std::move(measured.lines);
  return measuredRiversText(measured, grid);
}

// Rasters give depths to new nodes only.
void requireDepths(const Grid& grid, const std::string& name, const DepthOptions& options) {
  if (grid.z.empty() && !options.files.empty())
    throw InputError("'" + name +
                     "' has no depths, and --bathymetry gives them to new nodes only: first give all of it "
                     "depths, with coastmesh convert --bathymetry");
}

// Lines in degrees would be taken for lines at the origin of a mesh without a CRS.
void requireOnePlane(const std::vector<RiverLine>& lines, const Grid& grid, const std::string& name) {
  const auto isDegrees = [](const Box& box) {
    constexpr double kLon = 360.0, kLat = 90.0;
    return box.xmin >= -kLon && box.xmax <= kLon && box.ymin >= -kLat && box.ymax <= kLat;
  };
  const Box mesh = boxAround(grid.nodes, inOrder);
  if (!grid.crs.isPlane() || isDegrees(mesh)) return;
  Box box;
  for (const RiverLine& line : lines) box.add(boxAround(line.points, inOrder));
  if (isDegrees(box) && !box.meets(mesh))
    throw InputError("'" + name +
                     "' has no CRS, and the lines seem to be in degrees: name the mesh's with "
                     "--assume-crs");
}

std::string joined(const std::vector<std::string>& texts) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : "; ") + text;
  return all;
}

// Of the lines, or of the mesh there if it is deeper, else of rasters, else of the mesh there; nodes without any get
// what their neighbours have.
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
    // No sill across deeper water.
    if (!isKnown(grid.z[i]) || (isKnown(of_lines[i]) && laid.mesh_z[i] < grid.z[i])) grid.z[i] = laid.mesh_z[i];
  }
  fillFromNeighbours(grid, loop);
  const auto unknown = grid.z.size() - static_cast<std::size_t>(std::ranges::count_if(grid.z, isKnown));
  if (unknown == 0) return {};
  return grouped(unknown) + forCount(unknown, " node of rivers has", " nodes of rivers have") + " no depth";
}

// The mesh's attributes where rivers lie in it; further on along rivers those of their neighbours, or the default. A
// river is water, also in a flood plain.
void setRiverFields(Grid& rivers, const Grid& mesh, const ItemLoop& loop) {
  if (mesh.node_fields.empty()) return;
  const MeshTriangles triangles(mesh, boxAround(rivers.nodes, loop), loop);
  for (const NodeField& field : mesh.node_fields) {
    NodeField& made =
        rivers.node_fields.emplace_back(NodeField{field.name, field.unit, field.component, field.usual, {}});
    if (field.name == kFloodPlain) {
      made.values.assign(rivers.nodes.size(), 0.0);
      continue;
    }
    for (const Point& place : rivers.nodes) made.values.push_back(roundedValue(triangles.valueAt(field.values, place)));
    fillFromNeighbours(rivers, made.values, roundedValue, loop);
    for (double& value : made.values)
      if (std::isnan(value)) value = defaultOf(field);
  }
}

// What could have joined the mesh, but has no water of it beside it, is land.
void closeBanks(Grid& grid, const std::vector<MergeSource>& nodes) {
  for (Boundary& boundary : grid.boundaries)
    if (boundary.role == BoundaryRole::Open &&
        std::ranges::all_of(boundary.nodes, [&](std::uint32_t node) { return nodes[node].mesh == 1; }))
      boundary.role = BoundaryRole::Land;
}

// Between a river and what is left of the mesh, new nodes have the values that the mesh had there; depths only unless
// rasters give them.
void keepValues(Grid& grid, const MergedMesh& merged, bool keeps_depths) {
  const Grid& gone = merged.merged.gone;
  if ((grid.z.empty() && grid.node_fields.empty()) || gone.triangles.empty()) return;
  const MeshTriangles before(gone, boxAround(gone.nodes, inOrder));
  const auto keep = [](double value, double& kept) {
    if (!std::isnan(value)) kept = value;
  };
  for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
    if (merged.nodes[i].mesh != kNone) continue;
    if (keeps_depths && !grid.z.empty()) keep(before.zAt(grid.nodes[i]), grid.z[i]);
    for (NodeField& field : grid.node_fields)
      if (const NodeField* const known = findField(gone, field.name, field.component);
          known != nullptr && field.name != kFloodPlain)  // which has been settled with the depths
        keep(roundedValue(before.valueAt(known->values, grid.nodes[i])), field.values[i]);
  }
}

std::vector<std::uint32_t> numbersBefore(const std::vector<MergeSource>& sources) {
  std::vector<std::uint32_t> numbers;
  for (const MergeSource& source : sources) numbers.push_back(source.mesh == 0 ? source.number : kNone);
  return numbers;
}

std::vector<std::string> mergeWarnings(const MergedMesh& merged, const DepthOptions& depth) {
  std::vector<std::string> all{lostWaterText(merged.merged)};
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
    keepValues(grid, merged, options.depth.files.empty());
    return merged;
  } catch (const InputError& error) {
    throw InputError("the rivers cannot be added to '" + name + "': " + error.what());
  }
}

}  // namespace

EditedMesh runRiversJob(Grid& grid, const std::string& name, const std::vector<std::string>& lines,
                        const RiversJob& job, const Warn& warn, const JobControl& control) {
  const RefineOptions& bounds = job.merge.mesh.refine;
  RepairedTriangles repaired;
  const auto add = [&](const RunControl& of_edit, const ItemLoop& loop) {
    RiverOptions options = job.rivers;
    options.junctions = job.merge.mesh.refine;
    options.most_quads = std::min(options.most_quads, availableMemory() / kBytesPerQuad);
    requireDepths(grid, name, job.merge.depth);
    std::vector<RiverLine> read = readLines(lines, grid.crs, job);
    requireOnePlane(read, grid, name);
    MeshEdit edit;
    const std::string widths = takeWidths(read, job.banks, grid, edit.warnings, loop);
    LaidRivers laid = layRivers(read, grid, options, of_edit, loop);
    const std::vector<std::string> lost = lostRiverTexts(laid.report, grid);
    if (laid.grid.triangles.empty()) throw InputError("no river can be added to '" + name + "': " + joined(lost));
    for (const std::string& text : lost) warn(text);
    edit.warnings.push_back(landEndsText(laid.report));
    edit.warnings.push_back(narrowedRiversText(laid.report));
    edit.warnings.push_back(junctionTrianglesText(laid.report));
    edit.warnings.push_back(setRiverDepths(laid, grid, job.merge.depth, of_edit, loop));
    setRiverFields(laid.grid, grid, loop);
    const MergedMesh merged = putIn(grid, name, std::move(laid.grid), job.merge, of_edit, loop);
    std::ranges::move(mergeWarnings(merged, job.merge.depth), std::back_inserter(edit.warnings));
    edit.warnings.push_back(unconnectedRiversText(grid, merged.triangles));
    const std::string text = riversText(laid.report, grid) + widths;
    std::optional<LastingFigures> beside;
    if (merged.band)
      beside.emplace(merged.band->inside, job.finish.mayEdit(), grid, loop,
                     [&](std::size_t t) { return merged.triangles[t].mesh == kNone; });
    const std::string place = "in place of " + grouped(merged.replaced + merged.merged.covered) + "\n";
    edit.sources.nodes = numbersBefore(merged.nodes);
    edit.sources.triangles = numbersBefore(merged.triangles);
    const BeforeRepairs before(grid, job.finish.mayEdit(), loop);
    edit.text = [text, beside, place, before, &bounds, &repaired](const Grid& finished) {
      repaired = before.repairedIn(finished, bounds.min_angle_deg, bounds.max_angle_deg);
      return text + (beside ? "beside them: " + figuresText(beside->in(finished), finished) + place : "") +
             repairedText(repaired, finished) + grouped(finished.nodes.size()) + " nodes, " +
             elementCount(finished, grouped) + "\n" + riverBoundariesText(finished);
    };
    return edit;
  };
  EditedMesh edited = editMesh("rivers", grid, add, job.finish, control);
  if (repaired.below > 0) edited.warnings.push_back(repairedWarning(repaired));
  return edited;
}

}  // namespace coastmesh
