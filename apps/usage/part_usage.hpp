#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/job/finish_grid.hpp"
#include "apps/usage/option_table.hpp"
#include "core/item_loop.hpp"
#include "gis/cut/cut_region.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// What commands that change a part of a mesh have in common; `merge` has no region.
struct PartUsage {
  CutRegion region;
  FinishOptions finish;
  std::vector<std::string> outputs;
  std::string format;
  std::string numbers;  // the table with numbers in the mesh before; empty: none
  bool overwrite = false;
  bool quiet = false;
};

// Their words.
struct PartHelp {
  std::string inside, outside;  // what becomes of triangles in the part, and in polygons of --outside
  std::string targets;          // of --target
  std::string numbers_label, numbers;
};

// Declares --bbox, --within and --outside.
void declarePart(OptionTable& table, PartUsage& usage, const PartHelp& help);
// Declares --target, -o, --format, --numbers, --overwrite and --quiet.
void declarePartOutputs(OptionTable& table, PartUsage& usage, const PartHelp& help);

// `purpose`: "to cut out". Throws OptionError if no option chooses the part, and like `requireNumbers`.
void requirePart(const PartUsage& usage, const std::string& purpose);
// Throws OptionError for --numbers together with repairs.
void requireNumbers(const PartUsage& usage);
// `trianglesIn` the part. Throws InputError, also if there are none, with the path and the extent of the mesh.
std::vector<std::uint8_t> requireTriangles(const PartUsage& usage, const Grid& grid, const std::string& path,
                                           const std::string& purpose, std::vector<std::string>& warnings,
                                           const ItemLoop& loop);

}  // namespace coastmesh
