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

// The format of `path` by its ending, case-insensitive, or the format `name` if that is not empty. Throws OutputError
// with the list of known formats.
const GridFormat& gridFormatFor(const std::string& path, const std::string& name = {});

// A mesh that is written to a temporary folder and moved into place completely or not at all: see StagedFiles. A .prj
// beside the target with the grid's CRS is kept; one with another CRS counts as an existing target.
class StagedOutput {
 public:
  // Rejects what StagedFiles rejects, and a format that can only be read. Throws OutputError.
  StagedOutput(const std::string& path, const GridFormat& format, bool overwrite);

  // Input files of the run; a .prj that belongs to one of them is never replaced.
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

// The format of an existing file, by its content if several formats share its ending; null if none is known.
const GridFormat* gridFormatOf(const std::string& path);

// Reads a mesh in any readable format of `gridFormats`. Nodes, triangles and their winding are as in the file,
// including unused nodes; `boundaries` is empty if the file has none. Lines are those along edges inside the mesh;
// `notes` report other lines of the file. If the file has no CRS it is `unsaid`. Throws InputError.
Grid readGrid(const std::string& path, const Crs& unsaid = {});

// A remark for the user on a file that `readGrid` has read, if it had to choose, or missed a file that models can do
// without; else empty. Throws InputError.
std::string remarkOnGrid(const std::string& path);

// A line for the user on what the model's other files call the grid's open boundaries and rivers, where that is to be
// seen neither in the grid nor in `path`; else empty.
std::string openingsIn(const Grid& grid, const std::string& path, const GridFormat& format);

}  // namespace coastmesh
