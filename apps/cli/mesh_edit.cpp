#include "apps/cli/mesh_edit.hpp"

#include <cstdio>

#include "apps/cli/mesh_file.hpp"
#include "apps/cli/run_outputs.hpp"
#include "apps/process/exit_codes.hpp"
#include "apps/usage/grid_usage.hpp"
#include "gis/error.hpp"
#include "parallel/recorder.hpp"
#include "parallel/workers.hpp"

namespace coastmesh {

void declareEditOutputs(OptionTable& table, EditOutputs& outputs, const std::string& label, const std::string& help) {
  declareGridOutputs(table, outputs.meshes, outputs.format);
  table.output({"--numbers", label}, outputs.numbers, {}, help);
  table.flag({"--overwrite", "Replace files"}, outputs.overwrite, "replace files that exist");
  table.section(Section::Run);
  table.flag({"--quiet", "No summary"}, outputs.quiet, "print no summary");
}

void requireNumbers(const EditOutputs& outputs, const FinishOptions& finish) {
  if (!outputs.numbers.empty() && !finish.targets.empty())
    throw OptionError(
        "--numbers: repairs for --target add, move and remove nodes, so that numbers are no longer those of the mesh; "
        "leave --target out, and repair with convert --target if check finds anything");
}

int runMeshEdit(const MeshFile& mesh, const EditOutputs& asked,
                const std::function<EditedMesh(Grid& grid, const JobControl& control)>& edit, Run& run) {
  RunOutputs outputs(asked.overwrite, run.inputs, run.interrupt);
  outputs.addGrids(asked.meshes, asked.format);
  StagedFiles* const numbers = asked.numbers.empty() ? nullptr : &outputs.addFile(asked.numbers);
  Grid grid = readMeshFile(mesh, run);
  const JobControl control{[&run] { return run.interrupt.requested(); }, {}};
  const EditedMesh edited = edit(grid, control);
  for (const auto& some : {edited.warnings, outputs.numberWarnings(grid), outputs.lossWarnings(grid, LossesOf::Grid)})
    for (const std::string& warning : some) run.warn(warning);
  withThreads({}, [&] {
    Recorder recorder;
    const ItemLoop loop = recorder.loop("write", {control.cancelled, {}});
    outputs.writeGrids(grid, loop);
    if (numbers != nullptr)
      numbers->make([&](const std::string& path) { writeSources(edited.sources, grid, path, loop); });
  });
  const std::string summary = asked.quiet ? std::string() : edited.summary + outputs.openingsText(grid);
  outputs.commit();
  std::fputs(summary.c_str(), stdout);
  return edited.complete() ? kExitDone : kExitShort;
}

}  // namespace coastmesh
