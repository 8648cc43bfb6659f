#include "apps/cli/mesh_edit.hpp"

#include <cstdio>

#include "apps/cli/run_outputs.hpp"
#include "apps/job/finish_grid.hpp"
#include "apps/process/exit_codes.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "parallel/recorder.hpp"
#include "parallel/workers.hpp"

namespace coastmesh {

int runMeshEdit(const std::string& name, const MeshFile& mesh, const PartUsage& part,
                const std::function<MeshEdit(Grid& grid, const RunControl& control, const ItemLoop& loop)>& edit,
                Run& run) {
  RunOutputs outputs(part.overwrite, run.inputs, run.interrupt);
  outputs.addGrids(part.outputs, part.format);
  StagedFiles* const numbers = part.numbers.empty() ? nullptr : &outputs.addFile(part.numbers);
  Grid grid = readMeshFile(mesh, run);
  findMissingBoundaries(grid);
  const RunControl control{[&run] { return run.interrupt.requested(); }, {}};
  MeshEdit made;
  FinishReport finish;
  withThreads({}, [&] {
    Recorder recorder;
    const ItemLoop loop = recorder.loop(name, control);
    made = edit(grid, control, loop);
    finish = finishGrid(grid, part.finish, control, loop);
    if (part.finish.targets.empty()) made.warnings.push_back(windingWarning(grid, loop));
  });
  for (const auto& some :
       {made.warnings, finish.warnings(), outputs.numberWarnings(grid), outputs.lossWarnings(grid, LossesOf::Grid)})
    for (const std::string& warning : some)
      if (!warning.empty()) run.warn(warning);
  withThreads({}, [&] {
    Recorder recorder;
    outputs.writeGrids(grid, recorder.loop("write", control));
    if (numbers != nullptr)
      numbers->make([&](const std::string& path) { made.writeNumbers(path, recorder.loop("write", control)); });
  });
  outputs.commit();
  if (!part.quiet) std::fputs((made.text(grid) + finishSummary(part.finish, finish)).c_str(), stdout);
  return finish.repairs.left.empty() ? kExitDone : kExitShort;
}

}  // namespace coastmesh
