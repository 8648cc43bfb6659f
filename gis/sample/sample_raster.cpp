#include "gis/sample/sample_raster.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "gis/crs/crs_map.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/raster/raster_turn.hpp"
#include "gis/sample/stored_tiles.hpp"

namespace coastmesh {
namespace {

// The four pixels around a place: starting at `column`, `row`, with the place at `x`, `y` between their centres.
struct Corner {
  std::int64_t column = 0;
  std::int64_t row = 0;
  double x = 0.0;
  double y = 0.0;
};

// Within half a pixel of the raster's edge only the outermost pixels are used.
std::optional<Corner> cornerAt(const RasterBand& raster, const Point& pixel) {
  constexpr double kRounding = 1e-6;  // of a pixel
  const auto width = static_cast<double>(raster.columns()), height = static_cast<double>(raster.rows());
  const bool inside =
      pixel.x >= -kRounding && pixel.x <= width + kRounding && pixel.y >= -kRounding && pixel.y <= height + kRounding;
  if (!inside) return std::nullopt;  // also if not finite
  double x = pixel.x - 0.5, y = std::clamp(pixel.y - 0.5, 0.0, height - 1.0);
  if (!raster.wraps()) x = std::clamp(x, 0.0, width - 1.0);
  Corner corner{static_cast<std::int64_t>(std::floor(x)), static_cast<std::int64_t>(y)};
  if (!raster.wraps()) corner.column = std::min(corner.column, std::max<std::int64_t>(0, raster.columns() - 2));
  corner.row = std::min(corner.row, std::max<std::int64_t>(0, raster.rows() - 2));
  corner.x = x - static_cast<double>(corner.column);
  corner.y = y - static_cast<double>(corner.row);
  return corner;
}

// Values of the four pixels in rows; NaN for those without a value, or outside the raster.
RasterSample blend(const std::array<double, 4>& values, const Corner& corner) {
  double sum = 0.0, weights = 0.0;
  for (const int j : {0, 1}) {
    for (const int i : {0, 1}) {
      const double weight = (i == 0 ? 1.0 - corner.x : corner.x) * (j == 0 ? 1.0 - corner.y : corner.y);
      const double value = values[static_cast<std::size_t>(2 * j + i)];
      if (!(weight > 0.0) || std::isnan(value)) continue;
      sum += weight * value;
      weights += weight;
    }
  }
  if (!(weights > 0.0)) return {};
  constexpr double kAll = 1.0 - 1e-9;
  return {sum / weights, weights > kAll ? 1.0 : weights};
}

RasterSample highestOf(const std::array<double, 4>& values, const Corner& /*corner*/) {
  double highest = -std::numeric_limits<double>::infinity();
  for (const double value : values)
    if (value > highest) highest = value;
  return std::isinf(highest) ? RasterSample{} : RasterSample{highest, 1.0};
}

// Makes one value of the four pixels around a place.
using OfFour = RasterSample (*)(const std::array<double, 4>& values, const Corner& corner);

// A place in the raster: its tile, and its number.
struct Visit {
  StoredTile tile;
  std::size_t index = 0;

  friend auto operator<=>(const Visit&, const Visit&) = default;
};

// The places that have pixels around them, tile by tile.
class Visits {
 public:
  Visits(const RasterBand& raster, std::span<const Point> pixels, std::span<const std::uint32_t> which,
         const ItemLoop& loop)
      : raster_(raster), pixels_(pixels), which_(which) {
    in_order_ = joined(overStretches(loop, which.size(), [&](std::size_t first, std::size_t last) {
      std::vector<Visit> some;
      for (std::size_t i = first; i < last; ++i)
        if (const auto corner = cornerAt(raster, pixels[which[i]]))
          some.push_back({tileAt(raster, std::max<std::int64_t>(0, corner->column), corner->row), i});
      return some;
    }));
    sortOn(loop, in_order_);
  }

  std::size_t size() const { return in_order_.size(); }
  const Visit& operator[](std::size_t k) const { return in_order_[k]; }
  Corner corner(std::size_t k) const { return *cornerAt(raster_, pixels_[which_[in_order_[k].index]]); }
  // The end of each tile's visits.
  std::vector<std::size_t> ends() const {
    return endsOfTiles(in_order_.size(), [this](std::size_t k) { return in_order_[k].tile; });
  }

 private:
  const RasterBand& raster_;
  std::span<const Point> pixels_;
  std::span<const std::uint32_t> which_;
  std::vector<Visit> in_order_;
};

// Each pixel is read by the reader of its part of the raster.
std::vector<std::array<double, 4>> cornersByReaders(const RasterBand& raster, const Visits& visits,
                                                    const PixelReaders& readers, const ItemLoop& loop) {
  const RasterGeometry& geometry = raster.geometry();
  const PixelCuts cuts = partsOf(geometry);
  // One to four adjacent pixels of a visit; `first` is the number of the first among the four.
  struct Piece {
    std::size_t cell, visit;
    unsigned first;
    PixelRect at;
  };
  std::vector<Piece> pieces;
  for (std::size_t v = 0; v < visits.size(); ++v) {
    const Corner corner = visits.corner(v);
    const auto column = static_cast<int>(corner.column), row = static_cast<int>(corner.row);
    const auto add = [&](const PixelRect& rect, unsigned first) {
      const PixelRect inside = rect.in({0, 0, geometry.columns, geometry.rows});
      if (inside.isEmpty()) return;
      cuts.forEachCell(inside, [&](std::size_t cell) {
        const PixelRect at = inside.in(cuts.cell(cell));
        pieces.push_back({cell, v, first + static_cast<unsigned>(at.x - rect.x + 2 * (at.y - rect.y)), at});
      });
    };
    const bool turns = raster.wraps() && (column < 0 || column + 1 >= geometry.columns);
    if (!turns) {
      add({column, row, 2, 2}, 0);
      continue;
    }
    for (const int i : {0, 1})
      add({(column + i + geometry.columns) % geometry.columns, row, 1, 2}, static_cast<unsigned>(i));
  }
  std::ranges::stable_sort(pieces, {}, &Piece::cell);
  std::vector<RasterPart> parts;
  std::vector<PixelTask> tasks;
  constexpr std::size_t kMostWindows = 1 << 16;  // windows of a task
  std::size_t last = cuts.cells();
  for (const Piece& piece : pieces) {
    if (piece.cell != last || tasks.back().windows.size() >= kMostWindows) {
      tasks.push_back({raster.path(), geometry.columns, geometry.rows, {}});
      parts.push_back({raster.path(), ownedAs(geometry, piece.cell), 0});
      last = piece.cell;
    }
    tasks.back().windows.push_back(piece.at);
    parts.back().pixels += static_cast<std::uint64_t>(piece.at.width * piece.at.height);
  }
  const std::vector<PixelAnswer> answers = readers.read(tasks, readers.ownersOf(parts), loop);
  std::vector<std::array<double, 4>> corners(visits.size());
  for (auto& corner : corners) corner.fill(std::numeric_limits<double>::quiet_NaN());
  std::size_t p = 0;
  for (std::size_t t = 0; t < tasks.size(); ++t) {
    auto value = answers[t].values.begin();
    for (std::size_t w = 0; w < tasks[t].windows.size(); ++w, ++p)
      for (int k = 0; k < pieces[p].at.width * pieces[p].at.height; ++k) {
        const int i = k % pieces[p].at.width, j = k / pieces[p].at.width;
        corners[pieces[p].visit][pieces[p].first + static_cast<unsigned>(i + 2 * j)] = *value++;
      }
  }
  return corners;
}

// Samples the visits of one tile, `first` up to `last`.
void sampleTile(const RasterBand& raster, const Visits& visits, std::size_t first, std::size_t last, OfFour of_four,
                std::vector<RasterSample>& samples) {
  std::int64_t left = std::numeric_limits<std::int64_t>::max(), right = -left, top = left, bottom = -left;
  for (std::size_t k = first; k < last; ++k) {
    const Corner corner = visits.corner(k);
    left = std::min(left, corner.column);
    right = std::max(right, corner.column);
    top = std::min(top, corner.row);
    bottom = std::max(bottom, corner.row);
  }
  RasterWindow window{left, top, right + 2 - left, bottom + 2 - top};
  if (!raster.wraps()) window.columns = std::min(window.columns, raster.columns() - left);
  window.rows = std::min(window.rows, raster.rows() - top);
  const std::vector<double> values = raster.read(window);
  for (std::size_t k = first; k < last; ++k) {
    const Corner corner = visits.corner(k);
    std::array<double, 4> four;
    for (const int i : {0, 1, 2, 3}) {
      const std::int64_t column = corner.column + i % 2 - left, row = corner.row + i / 2 - top;
      four[static_cast<std::size_t>(i)] = column < window.columns && row < window.rows
                                              ? values[static_cast<std::size_t>(row * window.columns + column)]
                                              : std::numeric_limits<double>::quiet_NaN();
    }
    samples[visits[k].index] = of_four(four, corner);
  }
}

// Tile by tile; several at the same time.
std::vector<RasterSample> sampleTiles(const RasterBand& raster, const Visits& visits, std::size_t count, OfFour of_four,
                                      const ItemLoop& loop, const RunControl& control) {
  constexpr std::size_t kWorthAShare = 1 << 15;
  std::vector<RasterSample> samples(count);
  forEachTile(raster, visits.ends(), kWorthAShare, loop, control,
              [&](const RasterBand& own, std::size_t first, std::size_t last) {
                sampleTile(own, visits, first, last, of_four, samples);
              });
  return samples;
}

}  // namespace

std::vector<Point> pixelsOf(const Crs& crs, std::span<const Point> places, const RasterBand& raster,
                            const ItemLoop& loop) {
  const bool as_is = crs.isPlane() || raster.crs().isPlane() || sameCrs(crs, raster.crs());
  std::optional<CrsMap> map;
  if (!as_is) map.emplace(toOgr(crs), toOgr(raster.crs()));
  const RasterGeometry seen = asSeenFrom(crs, raster.geometry());
  const auto pixelOf = [&](const Point& place) { return seen.pixelOf(map ? map->forward(place) : place); };
  std::vector<Point> pixels;
  reserveOn(loop, pixels, places.size());
  pixels.resize(places.size());
  forEachByStretches(loop, pixels.size(), [&](std::size_t i) { pixels[i] = pixelOf(places[i]); });
  return pixels;
}

std::vector<Point> pixelsOf(const Grid& grid, const RasterBand& raster, const ItemLoop& loop) {
  return pixelsOf(grid.crs, grid.nodes, raster, loop);
}

std::vector<RasterSample> sampleBilinear(const RasterBand& raster, std::span<const Point> pixels,
                                         std::span<const std::uint32_t> which, const PixelReaders* readers,
                                         const ItemLoop& loop, const RunControl& control) {
  const Visits visits(raster, pixels, which, loop);
  if (readers == nullptr || !raster.geometry().is_exact)
    return sampleTiles(raster, visits, which.size(), blend, loop, control);
  std::vector<RasterSample> samples(which.size());
  const std::vector<std::array<double, 4>> corners = cornersByReaders(raster, visits, *readers, loop);
  for (std::size_t k = 0; k < visits.size(); ++k) samples[visits[k].index] = blend(corners[k], visits.corner(k));
  return samples;
}

std::vector<RasterSample> sampleHighest(const RasterBand& raster, std::span<const Point> pixels,
                                        std::span<const std::uint32_t> which, const ItemLoop& loop,
                                        const RunControl& control) {
  return sampleTiles(raster, Visits(raster, pixels, which, loop), which.size(), highestOf, loop, control);
}

}  // namespace coastmesh
