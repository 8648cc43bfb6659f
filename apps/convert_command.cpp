#include <cstdio>
#include <memory>

#include "apps/commands.hpp"
#include "apps/exit_codes.hpp"
#include "apps/finish_grid.hpp"
#include "apps/grid_outputs.hpp"
#include "apps/mesh_file.hpp"

namespace coastmesh {

namespace {

struct ConvertUsage {
  MeshFile mesh;
  std::vector<std::string> outputs;
  std::string format;
  FinishOptions finish;
  bool overwrite = false;
  bool quiet = false;
};

int runConvert(const ConvertUsage& usage, Interrupt& interrupt) {
  GridOutputs outputs(usage.outputs, usage.format, usage.overwrite, {usage.mesh.path}, interrupt);
  Grid grid = readMeshFile(usage.mesh);
  if (grid.boundaries.empty()) {
    // The file tells none: the rim of the mesh does.
    std::vector<EdgeConflict> conflicts;
    grid.boundaries = findBoundaries(toTriMesh(grid, Projection::plane(), conflicts));
  }
  const RunControl control{[&interrupt] { return interrupt.requested(); }, {}};
  const FinishReport report = finishGrid(grid, usage.finish, control);
  for (const std::string& warning : report.warnings())
    std::fprintf(stderr, "coastmesh: warning: %s\n", warning.c_str());
  if (const std::string warning = outputs.depthWarning(grid); !warning.empty())
    std::fprintf(stderr, "coastmesh: warning: %s\n", warning.c_str());
  for (const std::string& warning : outputs.lossWarnings(grid, LossesOf::Grid))
    std::fprintf(stderr, "coastmesh: warning: %s\n", warning.c_str());
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    interrupt.check();
    outputs.write(i, grid);
  }
  interrupt.close();
  outputs.commit();
  if (!usage.quiet) std::fputs(finishSummary(usage.finish, report).c_str(), stdout);
  return report.repairs.left.empty() ? kExitDone : kExitShort;
}

}  // namespace

Command declareConvert(CLI::App& root) {
  auto usage = std::make_shared<ConvertUsage>();
  CommandLine line(root, "convert", "Write a mesh in other formats");
  declareMeshFile(line, "MESH", "mesh to read", usage->mesh);
  line.texts("-o,--output", usage->outputs, kOutputFile, true, "mesh to write; repeat it for several");
  line.text("--format", usage->format, "NAME", "format of the output, where its ending does not tell");
  declareFinishOptions(line, usage->finish);
  line.flag("--overwrite", usage->overwrite, "replace files that exist");
  line.flag("--quiet", usage->quiet, "print no summary");
  line.example("coastmesh convert lake.nc -o lake.2dm -o lake.msh", "a grid in two other formats");
  return {std::move(line), [usage](Interrupt& interrupt) { return runConvert(*usage, interrupt); }};
}

}  // namespace coastmesh
