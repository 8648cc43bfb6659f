#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

class GDALDataset;

namespace coastmesh {

struct PixelRect {
  int x = 0, y = 0;  // of the first pixel
  int width = 0, height = 0;

  int right() const { return x + width; }
  int bottom() const { return y + height; }
  bool isEmpty() const { return width <= 0 || height <= 0; }
  PixelRect in(const PixelRect& other) const {
    const int left = std::max(x, other.x), top = std::max(y, other.y);
    return {left, top, std::min(right(), other.right()) - left, std::min(bottom(), other.bottom()) - top};
  }
  PixelRect shifted(int columns) const { return {x + columns, y, width, height}; }
  PixelRect grownBy(int across, int down) const {
    return {x - across, y - down, width + 2 * across, height + 2 * down};
  }
};

// Divides a raster into cells by straight cuts through all of it: `columns[i]` to `columns[i + 1]`, rows likewise.
struct PixelCuts {
  std::vector<int> columns, rows;  // the first is 0, the last the raster's end

  std::size_t across() const { return columns.size() - 1; }
  std::size_t cells() const { return across() * (rows.size() - 1); }
  PixelRect cell(std::size_t c) const {
    const std::size_t i = c % across(), j = c / across();
    return {columns[i], rows[j], columns[i + 1] - columns[i], rows[j + 1] - rows[j]};
  }
  // Calls `visit(cell)` for each cell that has pixels of the rectangle, row by row.
  template <typename Visit>
  void forEachCell(const PixelRect& rect, const Visit& visit) const {
    const auto first = [](const std::vector<int>& cuts, int at) {
      const auto after = std::ranges::upper_bound(cuts, at) - cuts.begin();
      return static_cast<std::size_t>(std::max<std::ptrdiff_t>(0, after - 1));
    };
    for (std::size_t j = first(rows, rect.y); j + 1 < rows.size() && rows[j] < rect.bottom(); ++j)
      for (std::size_t i = first(columns, rect.x); i + 1 < columns.size() && columns[i] < rect.right(); ++i)
        visit(j * across() + i);
  }
};

// A raster composed of files side by side, such as a VRT of tiles: none overlaps another, none is scaled.
struct RasterMosaic {
  std::vector<std::string> files;  // as the raster names them
  PixelCuts cuts;                  // along the files' edges
  std::vector<int> file_of;        // index into `files` for each cell; -1 if it has none

  template <typename Visit>
  void forEachFile(const PixelRect& rect, const Visit& visit) const {
    cuts.forEachCell(rect, [&](std::size_t cell) {
      if (file_of[cell] >= 0) visit(static_cast<std::size_t>(file_of[cell]));
    });
  }
};

// True for a VRT, which composes its pixels of other files and may warp or scale them.
bool isVirtual(GDALDataset& dataset);
// The netCDF files of a VRT, by extension, and the netCDF subdatasets that it names; empty for other rasters.
std::vector<std::string> netcdfFilesOf(GDALDataset& dataset);
// The mosaic of the first `columns` of the first band; null if the raster is not one, or does not describe it.
std::shared_ptr<const RasterMosaic> mosaicOf(GDALDataset& dataset, int columns);

}  // namespace coastmesh
