#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

#include "apps/cli/commands.hpp"
#include "apps/cli/mesh_edit.hpp"
#include "apps/job/places.hpp"
#include "apps/merge/merge_mesh.hpp"
#include "apps/report/remesh_texts.hpp"
#include "apps/report/report_sections.hpp"
#include "apps/usage/finish_usage.hpp"
#include "apps/usage/part_usage.hpp"
#include "gis/error.hpp"
#include "gis/for_count.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/merge/match_crs.hpp"
#include "gis/merge/source_table.hpp"

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
  std::size_t triangles = 0;
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
  Inserted done{path, inserted.triangles.size(), {}};
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
  if (inserted.result.band)
    std::ranges::move(newNodeWarnings(*inserted.result.band, usage.merge.depth), std::back_inserter(all));
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
  requireNumbers(usage.part);
  std::vector<Inserted> all;
  std::vector<MergeSource> nodes, triangles;
  const auto merge = [&](Grid& grid, const RunControl& control, const ItemLoop& loop) {
    MeshEdit edit;
    nodes = ownSources(grid.nodes.size());
    triangles = ownSources(grid.triangles.size());
    for (std::uint32_t i = 0; i < usage.inserted.size(); ++i) {
      all.push_back(putIn(grid, usage.inserted[i], usage, control, run, loop));
      nodes = composed(nodes, all.back().result.nodes, i + 1);
      triangles = composed(triangles, all.back().result.triangles, i + 1);
      std::ranges::move(warningsOf(all.back(), usage), std::back_inserter(edit.warnings));
    }
    edit.text = [&](const Grid& finished) {
      std::string text;
      for (const Inserted& inserted : all) text += textOf(inserted, finished);
      return text + grouped(finished.nodes.size()) + " nodes, " + grouped(finished.triangles.size()) + " triangles\n";
    };
    edit.writeNumbers = [&](const std::string& path, const ItemLoop& write) {
      writeSourceTable(nodes, triangles, path, write);
    };
    return edit;
  };
  return runMeshEdit("merge", usage.mesh, usage.part, merge, run);
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
