#pragma once

#include <string>
#include <vector>

#include "gis/grid_io.hpp"

namespace coastmesh {

// The files of one output.
struct OutputFiles {
  std::vector<std::string> targets;  // what the format writes; an existing one is not replaced without leave
  std::vector<std::string> stale;    // what other programs leave beside a target and take for up to date
  std::string prj;                   // where the CRS stands that a format has no room for; empty where it has
};

// How a format is written and read. Private to gis.
struct FormatFunctions {
  void (*write)(const Grid&, const std::string& path) = nullptr;
  Grid (*read)(const std::string& path) = nullptr;
  OutputFiles (*files)(const std::string& path) = nullptr;  // null: `path` and nothing else
};

const FormatFunctions& functionsOf(const GridFormat& format);
OutputFiles filesOf(const GridFormat& format, const std::string& path);

}  // namespace coastmesh
