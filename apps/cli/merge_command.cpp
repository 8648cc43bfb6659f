#include <cstdio>
#include <memory>
#include <utility>

#include "apps/cli/commands.hpp"
#include "apps/cli/mesh_file.hpp"
#include "apps/cli/run_outputs.hpp"
#include "apps/job/finish_grid.hpp"
#include "apps/job/places.hpp"
#include "apps/merge/merge_mesh.hpp"
#include "apps/process/exit_codes.hpp"
#include "apps/report/remesh_texts.hpp"
#include "apps/report/report_sections.hpp"
#include "apps/usage/finish_usage.hpp"
#include "apps/usage/part_usage.hpp"
#include "gis/error.hpp"
#include "gis/for_count.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/merge/match_crs.hpp"
#include "gis/merge/source_table.hpp"
#include "parallel/recorder.hpp"
#include "parallel/workers.hpp"

namespace coastmesh {

namespace {

struct MergeUsage {
  MeshFile mesh;
  std::vector<std::string> inserted;
  MergeOptions merge;
  PartUsage part;
};

// What is known of one mesh that was put in.
struct Inserted {
  std::string path;
  std::size_t triangles = 0, nodes = 0;
  MergedMesh result;
};

// Whether a mesh has depths while the other has none.
std::string depthWarning(const Grid& grid, const Grid& inserted, const std::string& path) {
  if (grid.z.empty() == inserted.z.empty()) return {};
  return inserted.z.empty() ? "'" + path + "' has no depths: unknown for its nodes"
                            : "only '" + path + "' has depths: unknown for all other nodes";
}

Inserted putIn(Grid& grid, const std::string& path, const MergeUsage& usage, const RunControl& control, Run& run,
               const ItemLoop& loop) {
  Grid inserted = readMeshFile({path, usage.mesh.crs}, run);
  findMissingBoundaries(inserted);
  matchCrs(inserted, grid, path);
  if (const std::string warning = depthWarning(grid, inserted, path); !warning.empty()) run.warn(warning);
  Inserted done{path, inserted.triangles.size(), inserted.nodes.size(), {}};
  try {
    done.result = mergeMesh(grid, std::move(inserted), usage.merge, control, loop);
  } catch (const InputError& error) {
    throw InputError("'" + path + "' cannot be put into '" + usage.mesh.path + "': " + error.what());
  }
  return done;
}

std::vector<std::string> warningsOf(const Inserted& inserted, const MergeUsage& usage) {
  const MergeReport& merged = inserted.result.merged;
  const std::string in = "'" + inserted.path + "': ";
  std::vector<std::string> all;
  if (!merged.has_open) all.push_back(in + "no open boundary, so that it joins the water of the other mesh all around");
  if (merged.walls > 0)
    all.push_back(in + grouped(merged.walls) +
                  forCount(merged.walls, " edge of its open boundaries is land now, as it has",
                           " edges of its open boundaries are land now, as they have") +
                  " no water of the other mesh beside it");
  if (merged.cut_off > 0)
    all.push_back(in + "it cuts waters off from the rest, which are left out: " + grouped(merged.cut_off) +
                  forCount(merged.cut_off, " triangle", " triangles"));
  if (merged.partition_dropped)
    all.emplace_back("the assignment to processes is of the meshes before, and left out; partition makes a new one");
  if (!inserted.result.band) return all;
  if (const std::string below = belowBoundsWarning(*inserted.result.band); !below.empty()) all.push_back(below);
  if (!usage.merge.depth.files.empty()) {
    const DepthReport& depth = inserted.result.band->depth;
    all.insert(all.end(), depth.warnings.begin(), depth.warnings.end());
  }
  return all;
}

std::string textOf(const Inserted& inserted, const Grid& grid) {
  const MergedMesh& result = inserted.result;
  std::string text = "'" + inserted.path + "': " + grouped(inserted.triangles) +
                     forCount(inserted.triangles, " triangle", " triangles") + " in place of " +
                     grouped(result.merged.covered) + ", joined along " + grouped(result.merged.joined) +
                     forCount(result.merged.joined, " edge", " edges") + "\n";
  if (result.merged.united > 0) text += "nodes that both have: " + grouped(result.merged.united) + "\n";
  if (result.band)
    text += "between both: " + figuresText(result.band->inside, grid) + "in place of " + grouped(result.replaced) +
            " around " + (result.merged.gap > 0 ? "the gap" : "the seam") + "\n";
  return text;
}

// Sources after one more mesh, number `mesh`, was put in.
std::vector<MergeSource> composed(const std::vector<MergeSource>& before, const std::vector<MergeSource>& last,
                                  std::uint32_t mesh) {
  std::vector<MergeSource> all;
  all.reserve(last.size());
  for (const MergeSource& source : last)
    all.push_back(source.mesh == 0   ? before[source.number]
                  : source.mesh == 1 ? MergeSource{mesh, source.number}
                                     : MergeSource{});
  return all;
}

std::vector<MergeSource> ownSources(std::size_t count) {
  std::vector<MergeSource> sources;
  for (std::uint32_t i = 0; i < count; ++i) sources.push_back({0, i});
  return sources;
}

int runMerge(const MergeUsage& usage, Run& run) {
  const PartUsage& part = usage.part;
  requireNumbers(part);
  RunOutputs outputs(part.overwrite, run.inputs, run.interrupt);
  outputs.addGrids(part.outputs, part.format);
  StagedFiles* const numbers = part.numbers.empty() ? nullptr : &outputs.addFile(part.numbers);
  Grid grid = readMeshFile(usage.mesh, run);
  findMissingBoundaries(grid);
  const RunControl control{[&run] { return run.interrupt.requested(); }, {}};
  std::vector<MergeSource> nodes = ownSources(grid.nodes.size()), triangles = ownSources(grid.triangles.size());
  std::vector<Inserted> all;
  FinishReport finish;
  std::string winding;
  withThreads({}, [&] {
    Recorder recorder;
    const ItemLoop loop = recorder.loop("merge", control);
    for (std::uint32_t i = 0; i < usage.inserted.size(); ++i) {
      all.push_back(putIn(grid, usage.inserted[i], usage, control, run, loop));
      nodes = composed(nodes, all.back().result.nodes, i + 1);
      triangles = composed(triangles, all.back().result.triangles, i + 1);
    }
    finish = finishGrid(grid, part.finish, control, loop);
    if (part.finish.targets.empty()) winding = windingWarning(grid, loop);
  });
  std::vector<std::string> warnings{winding};
  for (const Inserted& inserted : all)
    for (std::string& warning : warningsOf(inserted, usage)) warnings.push_back(std::move(warning));
  for (const auto& some :
       {warnings, finish.warnings(), outputs.numberWarnings(grid), outputs.lossWarnings(grid, LossesOf::Grid)})
    for (const std::string& warning : some)
      if (!warning.empty()) run.warn(warning);
  withThreads({}, [&] {
    Recorder recorder;
    outputs.writeGrids(grid, recorder.loop("write", control));
    if (numbers != nullptr)
      numbers->make(
          [&](const std::string& path) { writeSourceTable(nodes, triangles, path, recorder.loop("write", control)); });
  });
  outputs.commit();
  if (!part.quiet) {
    std::string text;
    for (const Inserted& inserted : all) text += textOf(inserted, grid);
    text += grouped(grid.nodes.size()) + " nodes, " + grouped(grid.triangles.size()) + " triangles\n";
    std::fputs((text + finishSummary(part.finish, finish)).c_str(), stdout);
  }
  return finish.repairs.left.empty() ? kExitDone : kExitShort;
}

}  // namespace

Command declareMerge(CLI::App& root) {
  auto usage = std::make_shared<MergeUsage>();
  OptionTable table = commandOptions("merge", "Put meshes into another one, with a graded transition");
  declareMeshFile(table, "MESH", "mesh to put the others into", usage->mesh);
  table.arguments("INSERT", usage->inserted,
                  "meshes to put in, in this order, in place of the triangles that they cover; each joins MESH along "
                  "its open boundaries, or all around if it has none");
  table.section(Section::Triangles);
  RefineOptions& refine = usage->merge.mesh.refine;
  table.number({"--min-angle", "Minimum angle"}, refine.min_angle_deg, "DEG", {0.0, 45.0},
               "minimum angle of the new triangles between the meshes");
  table.number({"--max-angle", "Maximum angle"}, refine.max_angle_deg, "DEG", {60.0, 180.0},
               "maximum angle of the new triangles; 180: no limit");
  table.section(Section::Sizes);
  table.number({"--grade", "Gradation of sizes"}, usage->merge.gradation, "G", {0.0, 1.0, true},
               "between the meshes, sizes at two places differ by at most this times their distance: a smaller number "
               "replaces more triangles of MESH");
  declareDepths(table, usage->merge.depth,
                "raster with the depths of new nodes; can be repeated, the first with a value at a node is used; "
                "without one, depths are linear between nodes of the meshes");
  const PartHelp help{{},
                      {},
                      "repair what the model would reject, in all of the mesh, and report each repair; can be repeated",
                      "Numbers in the meshes before",
                      "write a table (CSV) with the mesh that each node and triangle comes from, 1 for MESH, 2 for the "
                      "first INSERT, and "
                      "its number there; nothing for new ones"};
  declarePartOutputs(table, usage->part, help);
  table.example("coastmesh merge fort.14 bay.14 -o both.14 --assume-crs EPSG:4326", "a fine grid in a coarse one");
  table.example("coastmesh merge hgrid.gr3 bay.gr3 -o both.gr3 --target schism", "the same, repaired for a model");
  return {{root, std::move(table)}, [usage](Run& run) { return runMerge(*usage, run); }};
}

}  // namespace coastmesh
