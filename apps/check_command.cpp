#include <cstdio>
#include <map>
#include <memory>
#include <optional>

#include "apps/check_grid.hpp"
#include "apps/commands.hpp"
#include "apps/exit_codes.hpp"
#include "apps/input_usage.hpp"
#include "apps/mesh_file.hpp"
#include "apps/places.hpp"
#include "apps/staged_file.hpp"
#include "apps/vector_output.hpp"

namespace coastmesh {

namespace {

constexpr std::size_t kPlacesShown = 5;

struct CheckUsage {
  MeshFile mesh;
  InputOptions input;
  GridCheckOptions check;
  std::string output;
  bool overwrite = false;
  bool quiet = false;
};

void printDefects(const CheckUsage& usage, const Grid& grid, const std::vector<GridDefect>& defects) {
  std::printf("%s: %zu nodes, %zu triangles, %zu defects\n", usage.mesh.path.c_str(), grid.nodes.size(),
              grid.triangles.size(), defects.size());
  std::map<DefectKind, std::vector<const GridDefect*>> by_kind;
  for (const GridDefect& defect : defects) by_kind[defect.kind].push_back(&defect);
  for (const auto& [kind, of_kind] : by_kind) {
    std::printf("%s: %zu\n", std::string(toString(kind)).c_str(), of_kind.size());
    for (std::size_t i = 0; i < std::min(kPlacesShown, of_kind.size()); ++i) {
      std::printf("  at %s", pointText(of_kind[i]->place).c_str());
      if (of_kind[i]->triangle >= 0) std::printf(", triangle %s", std::to_string(of_kind[i]->triangle + 1).c_str());
      if (kind == DefectKind::AngleBelowBound) std::printf(", %.3f degrees", of_kind[i]->value);
      std::printf("\n");
    }
    if (of_kind.size() > kPlacesShown) std::printf("  and %zu more\n", of_kind.size() - kPlacesShown);
  }
}

VectorLayer layerOf(const std::vector<GridDefect>& defects) {
  VectorLayer layer;
  layer.name = "defects";
  layer.fields = {{"kind", std::string()}, {"triangle", std::int64_t{}}, {"value", 0.0}};
  for (const GridDefect& defect : defects) {
    const std::int64_t number = defect.triangle < 0 ? -1 : defect.triangle + 1;
    layer.shapes.push_back({{defect.place}, {std::string(toString(defect.kind)), number, defect.value}});
  }
  return layer;
}

int runCheck(const CheckUsage& usage, Interrupt& interrupt) {
  std::optional<StagedFile> output;
  if (!usage.output.empty()) {
    requireVectorFormat(usage.output, 1);
    output.emplace(usage.output, usage.overwrite, interrupt);
  }
  const Grid grid = readMeshFile(usage.mesh);
  interrupt.check();
  GridCheckOptions options = usage.check;
  std::vector<GridDefect> defects;
  if (usage.input.files.empty()) {
    defects = checkGrid(grid, options);
  } else {
    options.delaunay = true;
    defects = checkGridAgainst(grid, JobInput(usage.input), options);
  }
  if (output) {
    output->make([&](const std::string& path) { writeVectorLayers(path, grid.crs, {layerOf(defects)}); });
  }
  interrupt.close();
  if (output) output->commit();
  if (!usage.quiet) printDefects(usage, grid, defects);
  return defects.empty() ? kExitDone : kExitShort;
}

}  // namespace

Command declareCheck(CLI::App& root) {
  auto usage = std::make_shared<CheckUsage>();
  CommandLine line(root, "check", "Look for defects in a mesh; exit code 1 where there are any");
  declareMeshFile(line, "MESH", "mesh to check", usage->mesh);
  line.texts("--input", usage->input.files, kVectorFile, false,
             "what the mesh was made from: its points and edges have to be in the mesh; repeat it for several");
  line.number("--min-angle", usage->check.min_angle_deg, "DEG", {0.0, 60.0}, "smallest angle asked for");
  line.number("--max-angle", usage->check.max_angle_deg, "DEG", {60.0, 180.0}, "largest angle asked for");
  line.flag("--delaunay", usage->check.delaunay,
            "also look for edges that are not Delaunay; always done with --input, without which edges inside the mesh "
            "cannot be known as constraints");
  line.flag("--pinches", usage->check.pinches, "also look for nodes in which the mesh touches itself");
  declareInputOptions(line, usage->input);
  line.text("-o,--output", usage->output, kOutputFile,
            "write the defects as a layer of points: .gpkg, .geojson or .fgb");
  line.flag("--overwrite", usage->overwrite, "replace a file that exists");
  line.flag("--quiet", usage->quiet, "print nothing");
  line.example("coastmesh check lake.nc --input lake.geojson --min-angle 33",
               "is the mesh sound, does it hold the angle, is all of the input in it?");
  line.example("coastmesh check grid.2dm -o defects.gpkg", "the defects as a layer of points");
  return {std::move(line), [usage](Interrupt& interrupt) { return runCheck(*usage, interrupt); }};
}

}  // namespace coastmesh
