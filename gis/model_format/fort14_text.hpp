#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gis/file/text_writer.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// ADCIRC's fort.14, and SCHISM's hgrid.gr3, which has the same layout.
enum class Fort14Kind { Adcirc, Schism };

// Title, nodes at `places` with their depth (positive down), elements, then open and land boundaries. ADCIRC gets the
// halves of quadrilaterals. Loops other than islands are two linked segments, since neither program accepts a segment
// that ends where it starts. A river is a flux segment for ADCIRC and an open one for SCHISM. REQUIRES: every z is
// known.
void writeFort14(TextWriter& file, const Grid& grid, std::span<const Point> places, Fort14Kind kind,
                 const ItemLoop& loop);

// A line for the user if the file holds open boundaries that are rings; else empty. See `openingsIn`.
std::string openRingsText(const Grid& grid, const std::string& path);

// A value at each node in the layout of hgrid.gr3, without boundaries, as SCHISM reads friction and the like. REQUIRES:
// every value is known.
void writeGr3Values(TextWriter& file, const Grid& grid, std::span<const double> values, const ItemLoop& loop);

// Reads what `writeGr3Values` writes for this grid, by the order of the nodes. As for SCHISM the file may end after its
// nodes. Throws InputError, also if its first line has other numbers of elements and nodes.
std::vector<double> readGr3Values(const std::string& path, const Grid& grid);

// Reads either, with coordinates in `crs`. Segments are not required to run along the boundary; `notes` report counts,
// numbers and sums that are not as the programs require. `ids`, if not null, gets the numbers that nodes have in the
// file. Throws InputError.
Grid readFort14(const std::string& path, Crs crs, std::vector<std::int64_t>* ids = nullptr);

}  // namespace coastmesh
