#pragma once

#include <string>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/file/output_files.hpp"
#include "gis/format/grid_format.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// How a format is written and read.
struct FormatFunctions {
  // Uses the threads of `loop`; writes the same bytes for any number of them.
  void (*write)(const Grid&, const std::string& path, const ItemLoop& loop) = nullptr;
  // `unsaid` is the CRS if the file has none.
  Grid (*read)(const std::string& path, const Crs& unsaid) = nullptr;
  OutputFiles (*files)(const std::string& path) = nullptr;  // null: only `path`
  // For a format that shares its ending with another: returns whether `path` is of this format. Null: endings decide.
  bool (*holds)(const std::string& path) = nullptr;
  std::string (*remark)(const std::string& path) = nullptr;                 // see `remarkOnGrid`; null: there is none
  std::string (*openings)(const Grid&, const std::string& path) = nullptr;  // see `openingsIn`; null: nothing to say
};

struct FormatRecord {
  GridFormat format;
  FormatFunctions functions;
};

// Every format, in the order of messages, by the function that describes it; the function is in the file that writes
// the format. A new format is one line here.
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
  FORMAT(mikeFormat)                   \
  FORMAT(fesomFormat)                  \
  FORMAT(jigsawFormat)                 \
  FORMAT(mpasFormat)                   \
  FORMAT(sms2dmFormat)                 \
  FORMAT(gmshFormat)                   \
  FORMAT(gmsh22Format)                 \
  FORMAT(ww3Format)                    \
  FORMAT(triangleFormat)               \
  FORMAT(vtuFormat)                    \
  FORMAT(vtuGlobeFormat)               \
  FORMAT(plyFormat)                    \
  FORMAT(schismPartitionFormat)        \
  FORMAT(adcircPartitionFormat)        \
  FORMAT(fesomPartitionFormat)
#define COASTMESH_FORMAT(name) FormatRecord name();
COASTMESH_GRID_FORMATS(COASTMESH_FORMAT)
#undef COASTMESH_FORMAT

// `path` with its last ending replaced.
std::string withEnding(const std::string& path, const char* ending);
OutputFiles withPrjBeside(const std::string& path);  // `path`, and a .prj with its CRS
OutputFiles layerFiles(const std::string& path);     // one file each for triangles, nodes, boundaries, lines

const FormatFunctions& functionsOf(const GridFormat& format);

// The format with the longest ending that fits, case-insensitive: "_22.msh" before ".msh". Null if there is none.
const GridFormat* formatByEnding(const std::string& path);

}  // namespace coastmesh
