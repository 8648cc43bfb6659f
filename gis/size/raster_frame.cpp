#include "gis/size/raster_frame.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/metric.hpp"
#include "gis/crs/crs_map.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/raster/raster_mosaic.hpp"
#include "gis/raster/raster_turn.hpp"

namespace coastmesh {

namespace {

std::vector<int> startsBetween(const std::vector<int>& cuts) {
  std::vector<int> starts;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i)
    for (int at = cuts[i]; at < cuts[i + 1]; at += kTile) starts.push_back(at);
  return starts;
}

// Cuts along the edges of a mosaic's files, so that each tile is in one file; or where the spacing of pixels changes,
// so that the pixels of a tile have about one size.
std::vector<int> cutsOf(const RasterGeometry& raster, std::vector<int> PixelCuts::*of_files,
                        const std::shared_ptr<const UnevenAxis>& uneven) {
  if (raster.mosaic) return (*raster.mosaic).cuts.*of_files;
  return uneven ? uneven->cuts(kTile) : std::vector<int>{};
}

// Cuts tiles of rows further where a degree of longitude has become shorter or longer by a tenth since the last cut.
// Tiles of a raster with fine pixels are not cut below a sixteenth of a degree, so that they do not become too many
// near the poles.
std::vector<int> cutByParallels(const RasterGeometry& raster, std::vector<int> cuts) {
  constexpr double kAlike = 1.1, kLeastDegrees = 1.0 / 16.0;
  if (!(raster.period > 0.0) || raster.to_place[5] == 0.0) return cuts;
  const int least =
      static_cast<int>(std::clamp(std::ceil(kLeastDegrees / std::abs(raster.to_place[5])), 1.0, 1.0 * kTile));
  const auto lengthAt = [&](int row) {
    return std::abs(std::cos(toRadians(raster.placeOf({0.5 * raster.columns, static_cast<double>(row)}).y)));
  };
  std::vector<int> all{0};
  const std::vector<int> starts = startsBetween(cuts.empty() ? std::vector{0, raster.rows} : cuts);
  for (std::size_t t = 0; t < starts.size(); ++t) {
    if (t > 0) all.push_back(starts[t]);
    const int end = t + 1 < starts.size() ? starts[t + 1] : raster.rows;
    for (int row = starts[t] + least; row < end; row += least) {
      const double before = lengthAt(all.back()), here = lengthAt(row);
      if (here > kAlike * before || before > kAlike * here) all.push_back(row);
    }
  }
  if (all.size() == starts.size()) return cuts;
  all.push_back(raster.rows);
  return all;
}

}  // namespace

TileAxis::TileAxis(int pixels, const std::vector<int>& cuts) : pixels_(pixels) {
  if (cuts.empty()) return;
  starts_ = startsBetween(cuts);
  tile_of_.resize(static_cast<std::size_t>(pixels));
  for (std::size_t t = 0; t < starts_.size(); ++t)
    std::fill(tile_of_.begin() + starts_[t],
              t + 1 < starts_.size() ? tile_of_.begin() + starts_[t + 1] : tile_of_.end(), static_cast<int>(t));
}

RasterFrame::RasterFrame(const RasterGeometry& of, const Crs& input, const Projection& projection, const Box& box,
                         const ItemLoop& loop)
    : raster(asSeenFrom(input, of)),
      columns(of.columns, cutsOf(of, &PixelCuts::columns, of.uneven_columns)),
      rows(of.rows, cutByParallels(raster, cutsOf(of, &PixelCuts::rows, of.uneven_rows))) {
  // Between the input's CRS and the raster's, if they differ.
  std::optional<CrsMap> map;
  if (!raster.crs.isPlane() && !input.isPlane() && !sameCrs(raster.crs, input))
    map.emplace(toOgr(input), toOgr(raster.crs));
  const auto evenPixelOf = [seen = raster, map, projection](const Point& x) {
    const Point ground = projection.inverse(x);
    return seen.evenPixelOf(map ? map->forward(ground) : ground);
  };
  constexpr double kPixelTolerance = 0.1;
  to_even_pixel_ = std::make_unique<PlaneTable>(evenPixelOf, box, kPixelTolerance);
  findWindow(pixelsIn(box));
  const auto planeOf = [&](const Point& pixel) {
    const Point ground = raster.placeOf(pixel);
    return projection.forward(map ? map->inverse(ground) : ground);
  };
  const auto pixelSize = [&](const Point& middle, const Point& step) {
    const Point at = planeOf(middle);
    return distance(at, planeOf(middle + step)) / projection.scaleAt(at);
  };
  const auto across = static_cast<std::size_t>(window[2] - window[0]);
  places.resize(across * static_cast<std::size_t>(window[3] - window[1]));
  constexpr std::size_t kWorthAStretch = 64;
  const auto place = [&](std::size_t first, std::size_t last) {
    for (std::size_t t = first; t < last; ++t) {
      const int column = window[0] + static_cast<int>(t % across), row = window[1] + static_cast<int>(t / across);
      const int x = columns.start(column), y = rows.start(row);
      const PixelRect pixels{x, y, columns.start(column + 1) - x, rows.start(row + 1) - y};
      const Point middle{x + 0.5 * pixels.width, y + 0.5 * pixels.height};
      std::array<double, 2> pixel_m{pixelSize(middle, {1.0, 0.0}), pixelSize(middle, {0.0, 1.0})};
      // Beyond the working plane there is no domain, so no size is needed.
      if (!(pixel_m[0] > 0.0) || !(pixel_m[1] > 0.0) || !std::isfinite(pixel_m[0] + pixel_m[1])) pixel_m = {};
      places[t] = {pixels, pixel_m};
    }
  };
  forStretches(loop, places.size(), place, kWorthAStretch);
}

// From probes all over the box, with a margin.
Box RasterFrame::pixelsIn(const Box& box) const {
  constexpr int kProbes = 64;
  Box pixels;
  for (int j = 0; j <= kProbes; ++j) {
    for (int i = 0; i <= kProbes; ++i) {
      const Point p =
          pixelOf({box.xmin + (box.xmax - box.xmin) * i / kProbes, box.ymin + (box.ymax - box.ymin) * j / kProbes});
      if (std::isfinite(p.x) && std::isfinite(p.y)) pixels.add(p);
    }
  }
  if (pixels.empty()) return pixels;
  return pixels.grownBy(2.0 + std::max(pixels.xmax - pixels.xmin, pixels.ymax - pixels.ymin) / kProbes);
}

// Sets the window to the tiles with these pixels; leaves it empty if there are none.
void RasterFrame::findWindow(const Box& pixels) {
  if (pixels.empty() || pixels.xmax < 0.0 || pixels.ymax < 0.0) return;
  const auto tileOf = [](const TileAxis& axis, double pixel, int most) {
    return axis.tileOf(static_cast<int>(std::floor(std::clamp(pixel, 0.0, static_cast<double>(most)))));
  };
  const std::array<int, 4> found = {
      tileOf(columns, pixels.xmin, raster.columns), tileOf(rows, pixels.ymin, raster.rows),
      tileOf(columns, pixels.xmax, raster.columns - 1) + 1, tileOf(rows, pixels.ymax, raster.rows - 1) + 1};
  if (found[0] < found[2] && found[1] < found[3]) window = found;
}

}  // namespace coastmesh
