#pragma once

#include <string>
#include <vector>

namespace coastmesh {

struct GridFormat;

// The files of one output.
struct OutputFiles {
  std::vector<std::string> targets;  // what is written; an existing one is not replaced without leave
  std::vector<std::string> stale;    // what other programs leave beside a target and take for up to date
  std::string prj;                   // where the CRS stands that a format has no room for; empty where it has
};

// What a mesh of that format, written to `path`, consists of.
OutputFiles filesOf(const GridFormat& format, const std::string& path);

// Files that readers take for parts of the file `path`, by their names; most of them do not exist: a shapefile's .dbf,
// the .ele of a .node, a raster's .aux.xml. Of a folder, the files in it.
std::vector<std::string> companionsOf(const std::string& path);

}  // namespace coastmesh
