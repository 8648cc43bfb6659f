#include "apps/edit/mesh_edit.hpp"

#include <algorithm>
#include <iterator>

#include "apps/edit/mesh_file.hpp"
#include "apps/job/step_outcome.hpp"
#include "apps/report/report_sections.hpp"
#include "gis/cut/number_table.hpp"
#include "gis/elements/elements.hpp"
#include "gis/fields/node_fields.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/merge/source_table.hpp"
#include "parallel/recorder.hpp"
#include "parallel/workers.hpp"

namespace coastmesh {

namespace {

RunControl controlOf(std::string_view phase, const JobControl& control) {
  RunControl inner{control.cancelled, {}};
  if (control.progress) inner.progress = [&control, phase](double share) { control.progress(phase, share); };
  return inner;
}

}  // namespace

void writeSources(const EditSources& sources, const Grid& grid, const std::string& path, const ItemLoop& loop) {
  const Elements elements(grid);
  const auto elementBefore = [&](std::uint32_t mesh, std::uint32_t triangle) {
    const std::vector<std::uint32_t>& numbers = sources.elements_before[mesh];
    return numbers.empty() ? triangle : numbers[triangle];
  };
  if (sources.merged_nodes.empty()) {
    std::vector<std::uint32_t> before;
    for (std::size_t e = 0; e < elements.size(); ++e) {
      const std::uint32_t source = sources.triangles[elements.triangleOf(e)];
      before.push_back(source == kNone ? kNone : elementBefore(0, source));
    }
    return writeNumberTable(sources.nodes, elements, before, path, loop);
  }
  std::vector<MergeSource> before;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    MergeSource& source = before.emplace_back(sources.merged_triangles[elements.triangleOf(e)]);
    if (source.mesh != kNone) source.number = elementBefore(source.mesh, source.number);
  }
  writeSourceTable(sources.merged_nodes, elements, before, path, loop);
}

EditedMesh editMesh(std::string_view name, Grid& grid,
                    const std::function<MeshEdit(const RunControl& control, const ItemLoop& loop)>& edit,
                    const FinishOptions& finish, const JobControl& control) {
  findMissingBoundaries(grid);
  EditedMesh edited;
  withThreads({}, [&] {
    Recorder recorder;
    const RunControl of_edit = controlOf(name, control);
    of_edit.checkpoint(0.0);
    const ItemLoop loop = recorder.loop(name, of_edit);
    std::vector<std::uint32_t> elements_before = elementNumbers(grid);
    MeshEdit made = edit(of_edit, loop);
    std::vector<std::vector<std::uint32_t>>& before = made.sources.elements_before;
    before.insert(before.begin(), std::move(elements_before));
    of_edit.checkpoint(1.0);
    edited.finish = finishGrid(grid, finish, controlOf("finish", control), loop);
    roundStates(grid);
    if (finish.targets.empty()) made.warnings.push_back(windingWarning(grid, loop));
    edited.warnings = std::move(made.warnings);
    edited.sources = std::move(made.sources);
    edited.summary = made.text(grid) + stepText(measureStep(grid, loop), grid.crs.isPlane(), finish.targets) + "\n" +
                     finishSummary(finish, edited.finish);
  });
  std::ranges::move(edited.finish.warnings(), std::back_inserter(edited.warnings));
  std::erase(edited.warnings, std::string());
  return edited;
}

std::string editReport(const EditedMesh& edited, const std::vector<std::string>& warnings) {
  return textOf({{"coastmesh", COASTMESH_VERSION},
                 {"warnings", warnings},
                 {"repairs", Json::parse(repairSection(edited.finish))}});
}

}  // namespace coastmesh
