#include "gis/sample/sample_nearest.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "gis/sample/stored_tiles.hpp"

namespace coastmesh {
namespace {

// A pixel to be read: its tile, its place, and the number of the sample.
struct PixelVisit {
  StoredTile tile;
  std::int64_t column = 0, row = 0;
  std::size_t index = 0;
  bool lacks_value = false;

  auto operator<=>(const PixelVisit&) const = default;
};

std::optional<PixelVisit> visitAt(const RasterBand& raster, const Point& pixel, std::size_t index) {
  const auto width = static_cast<double>(raster.columns()), height = static_cast<double>(raster.rows());
  const bool inside = pixel.x >= 0.0 && pixel.x <= width && pixel.y >= 0.0 && pixel.y <= height;
  if (!inside) return std::nullopt;  // also if not finite
  const auto at = [](double x, std::int64_t count) { return std::min(static_cast<std::int64_t>(x), count - 1); };
  const std::int64_t column = at(pixel.x, raster.columns()), row = at(pixel.y, raster.rows());
  return PixelVisit{tileAt(raster, column, row), column, row, index};
}

// Reads the pixels of one tile.
void readTile(const RasterBand& raster, std::span<PixelVisit> visits, const PixelClasses* classes,
              std::vector<RasterSample>& samples) {
  const auto [left, right] = std::ranges::minmax(visits, {}, &PixelVisit::column);
  const auto [top, bottom] = std::ranges::minmax(visits, {}, &PixelVisit::row);
  const RasterWindow window{left.column, top.row, right.column + 1 - left.column, bottom.row + 1 - top.row};
  const std::vector<double> values = raster.read(window);
  for (PixelVisit& visit : visits) {
    const double read =
        values[static_cast<std::size_t>((visit.row - window.row) * window.columns + visit.column - window.column)];
    if (std::isnan(read)) continue;
    const std::optional<double> value = classes != nullptr ? classes->valueOf(read) : read;
    visit.lacks_value = !value;
    if (value) samples[visit.index] = {*value, 1.0};
  }
}

}  // namespace

std::vector<RasterSample> sampleNearest(const RasterBand& raster, std::span<const Point> pixels,
                                        std::span<const std::uint32_t> which, const PixelClasses* classes,
                                        const ItemLoop& loop, const RunControl& control) {
  std::vector<PixelVisit> visits;
  for (std::size_t i = 0; i < which.size(); ++i)
    if (const auto visit = visitAt(raster, pixels[which[i]], i)) visits.push_back(*visit);
  std::ranges::sort(visits);
  std::vector<RasterSample> samples(which.size());
  const std::vector<std::size_t> ends = endsOfTiles(visits.size(), [&visits](std::size_t k) { return visits[k].tile; });
  constexpr std::size_t kWorthAShare = 1 << 15;
  forEachTile(raster, ends, kWorthAShare, loop, control,
              [&](const RasterBand& own, std::size_t first, std::size_t last) {
                readTile(own, std::span(visits).subspan(first, last - first), classes, samples);
              });
  const auto lacking = std::ranges::find(visits, true, &PixelVisit::lacks_value);
  if (lacking != visits.end()) classes->failAt(raster, lacking->column, lacking->row);
  return samples;
}

}  // namespace coastmesh
