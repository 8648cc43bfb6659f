#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "apps/job/finish_grid.hpp"
#include "apps/job/mesh_job_options.hpp"
#include "core/item_loop.hpp"
#include "core/run_control.hpp"
#include "gis/grid/grid.hpp"
#include "gis/merge/merge_grids.hpp"

namespace coastmesh {

// Where the nodes and triangles of a changed mesh come from.
struct EditSources {
  std::vector<std::uint32_t> nodes, triangles;  // their numbers in the mesh before, from 0; kNone for new ones
  // Of a merged mesh instead. Mesh 0 is the one that the others, from 1, were put into.
  std::vector<MergeSource> merged_nodes, merged_triangles;
  // For each mesh before: the numbers of elements by triangle, from 0; empty if it had triangles only.
  std::vector<std::vector<std::uint32_t>> elements_before;
};

// Writes those of the nodes and elements of `grid` as a table (CSV). Throws OutputError.
void writeSources(const EditSources& sources, const Grid& grid, const std::string& path, const ItemLoop& loop);

// A change of a mesh.
struct MeshEdit {
  std::vector<std::string> warnings;                      // empty ones are left out
  std::function<std::string(const Grid& finished)> text;  // the summary, of the repaired mesh
  EditSources sources;
};

// The same, with the mesh repaired for models.
struct EditedMesh {
  std::vector<std::string> warnings;
  std::string summary;  // for users: lines, also of repairs
  EditSources sources;  // before repairs: if there are targets, they do not describe the mesh
  FinishReport finish;

  bool complete() const { return finish.repairs.left.empty(); }
};

// Changes a mesh by `edit`, on all cores, and repairs it for the targets of `finish`. `name`: of the change, and of its
// phase for `control.progress`; "finish" follows. REQUIRES: `name` has static lifetime. Throws what `edit` and
// `finishGrid` throw.
EditedMesh editMesh(std::string_view name, Grid& grid,
                    const std::function<MeshEdit(const RunControl& control, const ItemLoop& loop)>& edit,
                    const FinishOptions& finish, const JobControl& control);

// A report as JSON text, its keys as documented in apps/README.md. `warnings`: all of the run.
std::string editReport(const EditedMesh& edited, const std::vector<std::string>& warnings);

}  // namespace coastmesh
