#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gis/grid.hpp"

namespace coastmesh {

// A file format by its name ("gpkg") and the endings that choose it.
struct GridFormat {
  std::string_view name;
  std::vector<std::string_view> endings;
  std::string_view description;
  bool readable = false;
  bool writable = false;
};
const std::vector<GridFormat>& gridFormats();

// The format of `path` by its ending, or of `name` where that is not empty. Throws OutputError with the list of those
// known.
const GridFormat& gridFormatFor(const std::string& path, const std::string& name = {});

// Files written aside under temporary names in the target's folder; `commit` renames them all, the destructor removes
// what was not committed. A format that makes several files (`.shp`, `.node`) stages all of them.
class StagedOutput {
 public:
  // Refuses existing targets unless `overwrite`, and folders that do not exist. Throws OutputError.
  StagedOutput(std::string path, const GridFormat& format, bool overwrite);
  ~StagedOutput();
  StagedOutput(StagedOutput&&) noexcept;
  StagedOutput& operator=(StagedOutput&&) = delete;

  void write(const Grid& grid);
  void commit();

 private:
  std::string path_;
  const GridFormat* format_;
  bool overwrite_;
  std::string staging_folder_;
};

// Reads a mesh back: UGRID, Gmsh, 2dm, .node/.ele, GIS layers of triangles. Throws InputError.
Grid readGrid(const std::string& path);

}  // namespace coastmesh
