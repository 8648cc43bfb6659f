#include "gis/raster/raster_parts.hpp"

#include <algorithm>
#include <numeric>

#include "gis/error.hpp"

namespace coastmesh {

namespace {

// Cuts at multiples of a step.
std::vector<int> evenCuts(int end, std::int64_t step) {
  std::vector<int> cuts;
  for (std::int64_t at = 0; at < end; at += step) cuts.push_back(static_cast<int>(at));
  cuts.push_back(end);
  return cuts;
}

}  // namespace

PixelCuts partsOf(const RasterGeometry& raster) {
  if (raster.mosaic) return raster.mosaic->cuts;
  if (raster.in_order) return {{0, raster.columns}, {0, raster.rows}};
  constexpr std::int64_t kPartPixels = 1 << 24, kSide = 4096, kMostStep = 1 << 16;
  const std::int64_t across = std::lcm<std::int64_t>(raster.block_columns, kPartStep),
                     down = std::lcm<std::int64_t>(raster.block_rows, kPartStep);
  const std::int64_t width = raster.block_columns >= raster.columns || across > kMostStep
                                 ? raster.columns
                                 : across * std::max<std::int64_t>(1, kSide / across);
  const std::int64_t step = down > kMostStep ? raster.rows : down;
  const std::int64_t height = step * std::max<std::int64_t>(1, kPartPixels / width / step);
  return {evenCuts(raster.columns, width), evenCuts(raster.rows, height)};
}

std::size_t ownedAs(const RasterGeometry& raster, std::size_t cell) {
  if (!raster.mosaic) return cell;
  const int file = raster.mosaic->file_of[cell];
  return file >= 0 ? static_cast<std::size_t>(file) : raster.mosaic->files.size() + cell;
}

void requireSame(const RasterBand& band, int columns, int rows) {
  if (band.columns() == columns && band.rows() == rows) return;
  throw InputError("'" + band.path() + "' is another raster than it was: it has " + std::to_string(band.columns()) +
                   " columns and " + std::to_string(band.rows()) + " rows, not " + std::to_string(columns) + " and " +
                   std::to_string(rows));
}

PixelAnswer answerTask(const PixelTask& task) {
  constexpr int kMostSide = 1024;  // pixels: the largest window read at once
  const RasterBand band(task.path);
  requireSame(band, task.columns, task.rows);
  PixelAnswer answer;
  const std::size_t count = task.windows.size();
  for (std::size_t begin = 0, end = 0; begin < count; begin = end) {
    PixelRect all = task.windows[begin];
    for (end = begin + 1; end < count; ++end) {
      const PixelRect& next = task.windows[end];
      const int left = std::min(all.x, next.x), top = std::min(all.y, next.y);
      const PixelRect joined{left, top, std::max(all.right(), next.right()) - left,
                             std::max(all.bottom(), next.bottom()) - top};
      if (joined.width > kMostSide || joined.height > kMostSide) break;
      all = joined;
    }
    const std::vector<double> values = band.read({all.x, all.y, all.width, all.height});
    for (std::size_t w = begin; w < end; ++w) {
      const PixelRect& window = task.windows[w];
      for (int row = window.y; row < window.bottom(); ++row) {
        const auto from = values.begin() + static_cast<std::ptrdiff_t>(row - all.y) * all.width + (window.x - all.x);
        answer.values.insert(answer.values.end(), from, from + window.width);
      }
    }
  }
  answer.use = band.use();
  return answer;
}

}  // namespace coastmesh
