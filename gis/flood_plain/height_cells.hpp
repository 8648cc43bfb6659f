#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/coast/coastline.hpp"
#include "gis/flood_plain/flood_options.hpp"
#include "gis/geometry/box.hpp"

namespace coastmesh {

// A lattice of cells along the axes of a CRS: cell (0, 0) is the one in the south-west.
struct CellLattice {
  double west = 0.0, south = 0.0;    // the centre of the first cell
  double width = 1.0, height = 1.0;  // of a cell, in units of the CRS
  std::size_t columns = 0, rows = 0;

  std::size_t count() const { return columns * rows; }
  std::size_t at(std::size_t column, std::size_t row) const { return row * columns + column; }
  // The place of fractions of columns and rows, counted from the first centre.
  Point placeOf(double column, double row) const { return {west + column * width, south + row * height}; }
  Point centreOf(std::size_t cell) const {
    return placeOf(static_cast<double>(cell % columns), static_cast<double>(cell / columns));
  }
};

struct HeightCells {
  CellLattice lattice;
  std::vector<float> z;            // metres above the still water, one for each cell; NaN if unknown
  std::vector<std::string> notes;  // how they differ from the rasters' pixels
};

// Heights within the frames of the coastline, or all that the rasters have if there is no frame, and in two cells
// around. Cells are the pixels of the finest raster where they can be. If these are too many, cells are larger, with
// the mean of places in them as height. Throws InputError: no raster has a value there, a frame that reaches over most
// of the Earth, or one so large that cells would be larger than a third of `size_m`.
HeightCells heightCells(const Coastline& coastline, const FloodOptions& options, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
