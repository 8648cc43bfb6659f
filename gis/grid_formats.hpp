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

struct FormatRecord {
  GridFormat format;
  FormatFunctions functions;
};

// Every format, in the order of messages, by the function that tells of it, which stands in the file that writes it. A
// new format is one line here.
#define COASTMESH_GRID_FORMATS(FORMAT) \
  FORMAT(geoPackageFormat)             \
  FORMAT(geoJsonFormat)                \
  FORMAT(shapefileFormat)              \
  FORMAT(flatGeobufFormat)             \
  FORMAT(ugridFormat)                  \
  FORMAT(adcircFormat)                 \
  FORMAT(schismFormat)                 \
  FORMAT(telemacFormat)                \
  FORMAT(fvcomFormat)                  \
  FORMAT(sms2dmFormat)                 \
  FORMAT(gmshFormat)                   \
  FORMAT(gmsh22Format)                 \
  FORMAT(ww3Format)                    \
  FORMAT(triangleFormat)               \
  FORMAT(vtuFormat)
#define COASTMESH_FORMAT(name) FormatRecord name();
COASTMESH_GRID_FORMATS(COASTMESH_FORMAT)
#undef COASTMESH_FORMAT

// `path` with another ending in place of its last.
std::string withEnding(const std::string& path, const char* ending);
OutputFiles withPrjBeside(const std::string& path);  // `path`, and a .prj that says its CRS
OutputFiles layerFiles(const std::string& path);     // a file each for triangles, nodes, boundaries and lines

const FormatFunctions& functionsOf(const GridFormat& format);
OutputFiles filesOf(const GridFormat& format, const std::string& path);

}  // namespace coastmesh
