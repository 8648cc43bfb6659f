#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gis/grid.hpp"
#include "gis/grid_parts.hpp"

namespace coastmesh {

// A file format by its name ("gpkg") and the endings that choose it.
struct GridFormat {
  std::string_view name;
  std::vector<std::string_view> endings;  // none: only the name chooses it
  std::string_view description;
  bool readable = false;
  bool writable = false;
  GridParts holds;          // what its files hold of a grid, and its reader takes back
  bool says_depth = false;  // every file of it tells a depth at each node: 0 where the grid has none
};
const std::vector<GridFormat>& gridFormats();

// The format of `path` by its ending, in capitals or not, or of `name` where that is not empty. Throws OutputError with
// the list of those known.
const GridFormat& gridFormatFor(const std::string& path, const std::string& name = {});

// Files written aside under temporary names in the target's folder; `commit` renames them all, the destructor removes
// what was not committed. A format that makes several files (`.shp`, `.node`) stages all of them. A .prj beside the
// target that says the grid's CRS already is left as it is; one that says another counts as an existing target.
class StagedOutput {
 public:
  // Refuses existing targets unless `overwrite`, and folders that do not exist. Throws OutputError.
  StagedOutput(std::string path, const GridFormat& format, bool overwrite);
  ~StagedOutput();
  StagedOutput(StagedOutput&&) noexcept;
  StagedOutput& operator=(StagedOutput&&) = delete;

  // Throws OutputError, also for a grid without triangles.
  void write(const Grid& grid);
  // All files come into place or, where one cannot, none: then those that were there before are put back.
  void commit();

  // Holds everything that is not committed yet; for whoever has to end at once.
  const std::string& stagingFolder() const { return staging_folder_; }

 private:
  void refuseExisting() const;  // and folders, whatever `overwrite_`
  bool keepsPrj(const Grid& grid) const;

  std::string path_;
  const GridFormat* format_;
  bool overwrite_;
  std::string staging_folder_;  // empty once moved from or committed
  bool keep_prj_ = false;
};

// Reads a mesh back, in any format of `gridFormats` that is readable. Nodes, triangles and their winding are as
// the file has them, also unused nodes; `boundaries` is empty where the file tells none. Lines are those that run along
// edges inside the mesh; `notes` say where one of the file does not. Throws InputError.
Grid readGrid(const std::string& path);

}  // namespace coastmesh
