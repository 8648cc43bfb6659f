#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/file/staged_files.hpp"
#include "gis/format/grid_format.hpp"
#include "gis/grid/grid.hpp"
#include "gis/grid/grid_parts.hpp"

namespace coastmesh {

const std::vector<GridFormat>& gridFormats();

// The format of `path` by its ending, in capitals or not, or of `name` where that is not empty. Throws OutputError with
// the list of those known.
const GridFormat& gridFormatFor(const std::string& path, const std::string& name = {});

// A mesh written aside, to be moved into place whole or not at all: see StagedFiles. A .prj beside the target that says
// the grid's CRS already is left as it is; one that says another counts as an existing target.
class StagedOutput {
 public:
  // Refuses what StagedFiles refuses, and a format that can only be read. Throws OutputError.
  StagedOutput(const std::string& path, const GridFormat& format, bool overwrite);

  // Files that the run reads; a .prj that belongs to one of them is never replaced.
  void protect(const std::vector<std::string>& inputs) { inputs_ = inputs; }
  // Throws OutputError, also for a grid without triangles.
  void write(const Grid& grid, const ItemLoop& loop = inOrder);
  void commit() { files_.commit(); }

  const std::string& path() const { return files_.path(); }
  StagedFiles& files() { return files_; }
  const std::string& stagingFolder() const { return files_.stagingFolder(); }

 private:
  bool keepsPrj(const Grid& grid) const;

  const GridFormat* format_;
  StagedFiles files_;
  std::vector<std::string> inputs_;
};

// Reads a mesh back, in any format of `gridFormats` that is readable. Nodes, triangles and their winding are as
// the file has them, also unused nodes; `boundaries` is empty where the file has none. Lines are those that run along
// edges inside the mesh; `notes` say where one of the file does not. Where the file says no CRS it is
// `unsaid`. Throws InputError.
Grid readGrid(const std::string& path, const Crs& unsaid = {});

}  // namespace coastmesh
