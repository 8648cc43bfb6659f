#pragma once

#include <string>
#include <vector>

namespace coastmesh {

struct GridFormat;

// The files of one output.
struct OutputFiles {
  std::vector<std::string> targets;  // files to write; an existing one is not replaced without permission
  std::vector<std::string> stale;    // files that other programs leave beside a target and assume to be current
  std::string prj;                   // file with the CRS if the format cannot hold it; otherwise empty
};

// The files of a mesh of that format, written to `path`.
OutputFiles filesOf(const GridFormat& format, const std::string& path);

// Files that readers treat as parts of the file `path`, by their names; most of them do not exist: a shapefile's .dbf,
// the .ele of a .node, a raster's .aux.xml. For a folder: the files in it.
std::vector<std::string> companionsOf(const std::string& path);

}  // namespace coastmesh
