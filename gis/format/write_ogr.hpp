#pragma once

#include <cstdint>
#include <string>

#include "gis/grid/grid.hpp"

namespace coastmesh {

// Write the grid's layers `triangles`, `nodes` (with z in the geometry too), `boundaries` and `lines`: to one
// GeoPackage, or to one Shapefile or FlatGeobuf each (`pathOfLayer`). Real columns of a shapefile keep 15 decimals, its
// coordinates all bits. Throw OutputError.
void writeGeoPackage(const Grid& grid, const std::string& path, const ItemLoop& loop = inOrder);
void writeShapefile(const Grid& grid, const std::string& path, const ItemLoop& loop = inOrder);
void writeFlatGeobuf(const Grid& grid, const std::string& path, const ItemLoop& loop = inOrder);

// Throws OutputError if a shapefile of `rows` records of `shape_bytes` and `table_bytes` each would exceed the 2 GB
// that its offsets can address.
void requireShapefileSize(const std::string& path, std::uint64_t rows, std::uint64_t shape_bytes,
                          std::uint64_t table_bytes);

}  // namespace coastmesh
