#pragma once

#include <string>

#include "gis/file/text_writer.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// ADCIRC's fort.14, whose layout SCHISM's hgrid.gr3 shares.
enum class Fort14Kind { Adcirc, Schism };

// Title, nodes at `places` with their depth (positive down), triangles, then open boundaries and those of land. Loops
// that are no islands come as two linked segments, as neither program takes a segment that ends where it starts. A
// river is a flux segment to ADCIRC and an open one to SCHISM. REQUIRES: no z is unknown.
void writeFort14(TextWriter& file, const Grid& grid, const std::vector<Point>& places, Fort14Kind kind,
                 const ItemLoop& loop);

// Reads either; the CRS is left out. Segments are taken as they stand, whatever they follow; the `notes` say where
// counts, numbers and sums are not what the programs demand. Throws InputError.
Grid readFort14(const std::string& path);

}  // namespace coastmesh
