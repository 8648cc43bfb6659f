#include "gis/size/size_raster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/metric.hpp"
#include "gis/crs/crs_map.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"

namespace coastmesh {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr float kNothing = std::numeric_limits<float>::infinity();
constexpr int kTile = 256;  // pixels along a side, a power of two
// Sizes in a cell of the quadtree are as alike as this, or the cell is no larger than this share of the least.
constexpr float kAlike = 1.04F;
constexpr double kFineShare = 0.5;
constexpr double kSteepShare = 0.6;
// More surroundings than this, in pixels, are not looked at.
constexpr int kMostMargin = 200;

// The tile's values with its margin: as far as the raster goes, which is round the Earth where it wraps.
void readTile(const RasterBand& band, int x, int y, RasterTile& tile) {
  const RasterGeometry& raster = band.geometry();
  const int height = tile.height + 2 * tile.margin;
  tile.values.assign(tile.stride() * static_cast<std::size_t>(height), std::nanf(""));
  const int left = x - tile.margin, right = x + tile.width + tile.margin;
  const int x0 = raster.wraps ? left : std::max(0, left), x1 = raster.wraps ? right : std::min(raster.columns, right);
  const int y0 = std::max(0, y - tile.margin), y1 = std::min(raster.rows, y + tile.height + tile.margin);
  if (x0 >= x1 || y0 >= y1) return;
  const std::vector<double> values = band.read({x0, y0, x1 - x0, y1 - y0});
  const auto columns = static_cast<std::size_t>(x1 - x0);
  for (std::size_t row = 0; row < static_cast<std::size_t>(y1 - y0); ++row) {
    const std::size_t to = (row + static_cast<std::size_t>(y0 - y + tile.margin)) * tile.stride();
    for (std::size_t column = 0; column < columns; ++column)
      tile.values[to + column + static_cast<std::size_t>(x0 - left)] =
          static_cast<float>(values[row * columns + column]);
  }
}

// The pixels that a box of the working plane lies in, from places all over it, with some around; empty where the raster
// does not reach.
Box pixelsIn(const Box& box, const PlaneTable& to_pixel) {
  constexpr int kProbes = 64;
  Box pixels;
  for (int j = 0; j <= kProbes; ++j) {
    for (int i = 0; i <= kProbes; ++i) {
      const Point p =
          to_pixel.at({box.xmin + (box.xmax - box.xmin) * i / kProbes, box.ymin + (box.ymax - box.ymin) * j / kProbes});
      if (std::isfinite(p.x) && std::isfinite(p.y)) pixels.add(p);
    }
  }
  if (pixels.empty()) return pixels;
  return pixels.grownBy(2.0 + std::max(pixels.xmax - pixels.xmin, pixels.ymax - pixels.ymin) / kProbes);
}

// The tiles that hold these pixels: first column and row, and the ends; all 0 where none do.
std::array<int, 4> tilesOf(const Box& pixels, const RasterGeometry& raster) {
  if (pixels.empty() || pixels.xmax < 0.0 || pixels.ymax < 0.0) return {};
  const auto tileOf = [](double pixel, int most) {
    return static_cast<int>(std::floor(std::clamp(pixel, 0.0, static_cast<double>(most)) / kTile));
  };
  const std::array<int, 4> window = {tileOf(pixels.xmin, raster.columns), tileOf(pixels.ymin, raster.rows),
                                     tileOf(pixels.xmax, raster.columns - 1) + 1,
                                     tileOf(pixels.ymax, raster.rows - 1) + 1};
  return window[0] < window[2] && window[1] < window[3] ? window : std::array<int, 4>{};
}

// As many pixels round a tile as the rule looks at, and one; none where it looks at none: files have blocks as large as
// tiles, and each margin has those round it unpacked once more. Throws InputError.
int marginOf(const RasterTile& tile, const TileRule& rule) {
  if (!(rule.margin_m > 0.0)) return 0;
  const double margin = std::ceil(rule.margin_m / std::min(tile.pixel_m[0], tile.pixel_m[1]));
  if (margin > kMostMargin)
    throw InputError(tile.file +
                     ": its pixels are too fine for a filter that long: give a coarser raster, or filter over less");
  return 1 + static_cast<int>(margin);
}

}  // namespace

RasterField::RasterField(const RasterGeometry& raster, const Crs& input, const Projection& projection, const Box& box,
                         const TileRule& rule, const ItemLoop& loop)
    : raster_(raster) {
  // From the working plane to the raster's own coordinates: both CRS, where there are two.
  std::optional<CrsMap> map;
  if (!raster.crs.isPlane() && !input.isPlane() && !sameCrs(raster.crs, input))
    map.emplace(toOgr(input), toOgr(raster.crs));
  const auto pixelOf = [raster, map, projection](const Point& x) {
    const Point ground = projection.inverse(x);
    return raster.pixelOf(map ? map->forward(ground) : ground);
  };
  constexpr double kPixelTolerance = 0.1;
  to_pixel_ = std::make_unique<PlaneTable>(pixelOf, box, kPixelTolerance);
  window_ = tilesOf(pixelsIn(box, *to_pixel_), raster);
  const auto planeOf = [&](const Point& pixel) {
    const Point ground = raster_.placeOf(pixel);
    return projection.forward(map ? map->inverse(ground) : ground);
  };
  const auto pixelSize = [&](const Point& middle, const Point& step) {
    const Point at = planeOf(middle);
    return distance(at, planeOf(middle + step)) / projection.scaleAt(at);
  };
  readTiles(pixelSize, rule, loop);
}

template <typename PixelSize>
void RasterField::readTiles(const PixelSize& pixelSize, const TileRule& rule, const ItemLoop& loop) {
  const auto columns = static_cast<std::size_t>(window_[2] - window_[0]);
  tiles_.resize(columns * static_cast<std::size_t>(window_[3] - window_[1]));
  if (tiles_.empty()) return;
  constexpr std::size_t kWorthAStretch = 4;
  const auto read = [&](std::size_t first, std::size_t last) {
    const RasterBand band(raster_.path);
    RasterTile tile;
    tile.file = raster_.path;
    std::vector<float> sizes;
    for (std::size_t t = first; t < last; ++t) {
      const int x = (window_[0] + static_cast<int>(t % columns)) * kTile;
      const int y = (window_[1] + static_cast<int>(t / columns)) * kTile;
      tile.width = std::min(kTile, raster_.columns - x);
      tile.height = std::min(kTile, raster_.rows - y);
      const Point middle{x + 0.5 * tile.width, y + 0.5 * tile.height};
      tile.pixel_m[0] = pixelSize(middle, {1.0, 0.0});
      tile.pixel_m[1] = pixelSize(middle, {0.0, 1.0});
      // Where the working plane does not reach, the domain does not either.
      if (!(tile.pixel_m[0] > 0.0) || !(tile.pixel_m[1] > 0.0) || !std::isfinite(tile.pixel_m[0] + tile.pixel_m[1])) {
        tiles_[t] = {{kNothing, kNothing, kNothing, 0}};
        continue;
      }
      tile.margin = marginOf(tile, rule);
      readTile(band, x, y, tile);
      sizes.assign(static_cast<std::size_t>(tile.width) * static_cast<std::size_t>(tile.height), kNothing);
      rule.sizes(tile, sizes);
      tiles_[t] = compress(tile, sizes);
    }
  };
  forStretches(loop, tiles_.size(), read, kWorthAStretch);
  for (const Tile& tile : tiles_) least_ = std::min(least_, static_cast<double>(tile.front().low));
}

RasterField::Tile RasterField::compress(const RasterTile& tile, std::span<const float> sizes) const {
  // Pyramids of the least, the most, and the mean of what is wanted.
  struct Level {
    std::vector<float> low, high, sum, count;
  };
  std::vector<Level> levels(1);
  const auto cellsOf = [](int side) { return static_cast<std::size_t>(side) * static_cast<std::size_t>(side); };
  for (auto* of : {&levels[0].high, &levels[0].sum, &levels[0].count}) of->assign(cellsOf(kTile), 0.0F);
  levels[0].low.assign(cellsOf(kTile), kNothing);
  // Beyond the raster nothing is wanted, but that does not make its last pixels unlike one another.
  for (int y = 0; y < tile.height; ++y) {
    for (int x = 0; x < tile.width; ++x) {
      const float size =
          sizes[static_cast<std::size_t>(y) * static_cast<std::size_t>(tile.width) + static_cast<std::size_t>(x)];
      const std::size_t k = static_cast<std::size_t>(y) * kTile + static_cast<std::size_t>(x);
      levels[0].low[k] = levels[0].high[k] = size;
      if (!std::isfinite(size)) continue;
      levels[0].sum[k] = size;
      levels[0].count[k] = 1.0F;
    }
  }
  for (int side = kTile / 2; side >= 1; side /= 2) {
    const Level& fine = levels.back();
    Level coarse;
    for (int y = 0; y < side; ++y) {
      for (int x = 0; x < side; ++x) {
        float low = kNothing, high = 0.0F, sum = 0.0F, count = 0.0F;
        for (int k = 0; k < 4; ++k) {
          const std::size_t f = static_cast<std::size_t>(2 * y + k / 2) * static_cast<std::size_t>(2 * side) +
                                static_cast<std::size_t>(2 * x + k % 2);
          low = std::min(low, fine.low[f]);
          high = std::max(high, fine.high[f]);
          sum += fine.sum[f];
          count += fine.count[f];
        }
        coarse.low.push_back(low);
        coarse.high.push_back(high);
        coarse.sum.push_back(sum);
        coarse.count.push_back(count);
      }
    }
    levels.push_back(std::move(coarse));
  }
  Tile nodes;
  struct Work {
    std::uint32_t node;
    std::size_t level;
    int x, y;
  };
  std::vector<Work> stack{{0, levels.size() - 1, 0, 0}};
  nodes.push_back({});
  const double pixel_m = std::max(tile.pixel_m[0], tile.pixel_m[1]);
  while (!stack.empty()) {
    const Work work = stack.back();
    stack.pop_back();
    const Level& level = levels[work.level];
    const int cells = kTile >> work.level;
    const std::size_t k =
        static_cast<std::size_t>(work.y) * static_cast<std::size_t>(cells) + static_cast<std::size_t>(work.x);
    const float low = level.low[k], high = level.high[k];
    const float mean = level.count[k] > 0.0F ? level.sum[k] / level.count[k] : kNothing;
    const double side_m = pixel_m * static_cast<double>(1 << work.level);
    const bool alike = high <= kAlike * low || (work.level > 0 && side_m <= kFineShare * low);
    nodes[work.node] = {low, high, mean, 0};
    if (work.level == 0 || low == kNothing || alike) {
      if (alike && low != kNothing && high != kNothing) nodes[work.node].low = nodes[work.node].high = mean;
      continue;
    }
    const auto below = static_cast<std::uint32_t>(nodes.size());
    nodes[work.node].below = below;
    for (int c = 0; c < 4; ++c) {
      nodes.push_back({});
      stack.push_back({below + static_cast<std::uint32_t>(c), work.level - 1, 2 * work.x + c % 2, 2 * work.y + c / 2});
    }
  }
  nodes.shrink_to_fit();
  return nodes;
}

// The size at a pixel; infinite beyond what was kept.
float RasterField::pixel(std::int64_t x, std::int64_t y) const {
  if (raster_.wraps) x = (x % raster_.columns + raster_.columns) % raster_.columns;
  const std::int64_t column = x / kTile - window_[0], row = y / kTile - window_[1];
  if (x < 0 || y < 0 || column < 0 || row < 0 || column >= window_[2] - window_[0] || row >= window_[3] - window_[1])
    return kNothing;
  const Tile& tile = tiles_[static_cast<std::size_t>(row * (window_[2] - window_[0]) + column)];
  std::uint32_t node = 0;
  for (int half = kTile / 2; tile[node].below != 0; half /= 2)
    node = tile[node].below + ((x & half) != 0) + 2 * ((y & half) != 0);
  return tile[node].value;
}

void RasterField::sample(std::span<const Point> places, std::span<double> sizes) const {
  for (std::size_t i = 0; i < places.size(); ++i) {
    sizes[i] = kInfinity;
    if (tiles_.empty()) continue;
    const Point p = to_pixel_->at(places[i]);
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) continue;
    // Half a pixel beyond the last centres, the nearest counts.
    if (!raster_.wraps && (p.x < 0.0 || p.x > raster_.columns)) continue;
    if (p.y < 0.0 || p.y > raster_.rows) continue;
    const double u = p.x - 0.5, v = p.y - 0.5;
    const double x = std::floor(u), y = std::floor(v);
    double sum = 0.0, weight = 0.0;
    for (int k = 0; k < 4; ++k) {
      const double share = (k % 2 ? u - x : 1.0 - (u - x)) * (k / 2 ? v - y : 1.0 - (v - y));
      const float size = pixel(static_cast<std::int64_t>(x) + k % 2, static_cast<std::int64_t>(y) + k / 2);
      if (!std::isfinite(size) || share <= 0.0) continue;
      sum += share * size;
      weight += share;
    }
    if (weight > 0.0) sizes[i] = sum / weight;
    // A pixel much smaller than those round it holds as far as it reaches: between centres its own size would hardly be
    // found.
    const float own = pixel(static_cast<std::int64_t>(std::floor(p.x)), static_cast<std::int64_t>(std::floor(p.y)));
    if (own < kSteepShare * sizes[i]) sizes[i] = own;
  }
}

// Of what `sample` returns in a box of a few pixels, given in pixels. Between the lines through pixels' centres and
// along their edges sizes are bilinear or a pixel's own, so that corners tell; the bounds of all pixels near it would
// be far off where one is much smaller than those round it.
SizeRange RasterField::boundBetween(const Box& pixels) const {
  if (pixels.ymax < 0.0 || pixels.ymin > raster_.rows) return {kInfinity, kInfinity};
  if (!raster_.wraps && (pixels.xmax < 0.0 || pixels.xmin > raster_.columns)) return {kInfinity, kInfinity};
  const auto knots = [](double from, double to) {
    std::vector<double> at{from};
    for (double k = std::floor(2.0 * from) + 1.0; k < 2.0 * to; k += 1.0) at.push_back(0.5 * k);
    at.push_back(to);
    return at;
  };
  const std::vector<double> xs = knots(pixels.xmin, pixels.xmax), ys = knots(pixels.ymin, pixels.ymax);
  SizeRange range{kInfinity, 0.0};
  for (std::size_t j = 0; j + 1 < ys.size(); ++j) {
    for (std::size_t i = 0; i + 1 < xs.size(); ++i) {
      const double x = 0.5 * (xs[i] + xs[i + 1]), y = 0.5 * (ys[j] + ys[j + 1]);
      if ((!raster_.wraps && (x < 0.0 || x > raster_.columns)) || y < 0.0 || y > raster_.rows) {
        range.high = kInfinity;
        continue;
      }
      const double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
      std::array<double, 4> around;
      for (int k = 0; k < 4; ++k)
        around[static_cast<std::size_t>(k)] =
            pixel(static_cast<std::int64_t>(left) + k % 2, static_cast<std::int64_t>(top) + k / 2);
      double low = kInfinity, high = 0.0;
      const bool all = std::ranges::all_of(around, [](double size) { return std::isfinite(size); });
      for (int k = 0; k < 4; ++k) {
        double size = around[static_cast<std::size_t>(k)];
        if (all) {
          const double u = xs[i + static_cast<std::size_t>(k % 2)] - 0.5 - left;
          const double v = ys[j + static_cast<std::size_t>(k / 2)] - 0.5 - top;
          size = (1.0 - v) * ((1.0 - u) * around[0] + u * around[1]) + v * ((1.0 - u) * around[2] + u * around[3]);
        }
        low = std::min(low, size);
        if (std::isfinite(size)) high = std::max(high, size);
      }
      if (low == kInfinity) high = kInfinity;
      const double own = pixel(static_cast<std::int64_t>(std::floor(x)), static_cast<std::int64_t>(std::floor(y)));
      if (own < kSteepShare * high) {
        high = own < kSteepShare * low ? own : own / kSteepShare;
        low = std::min(low, own);
      }
      range = {std::min(range.low, low), std::max(range.high, high)};
    }
  }
  return range;
}

void RasterField::boundIn(const Tile& tile, std::uint32_t node, int x, int y, int side,
                          const std::array<std::int64_t, 4>& window, SizeRange& range) const {
  const Node& n = tile[node];
  if (x >= window[2] || y >= window[3] || x + side <= window[0] || y + side <= window[1]) return;
  const bool covered = x >= window[0] && y >= window[1] && x + side <= window[2] && y + side <= window[3];
  if (covered || n.below == 0 || (n.low >= range.low && n.high <= range.high)) {
    range.low = std::min(range.low, static_cast<double>(n.low));
    range.high = std::max(range.high, static_cast<double>(n.high));
    return;
  }
  const int half = side / 2;
  for (int k = 0; k < 4; ++k)
    boundIn(tile, n.below + static_cast<std::uint32_t>(k), x + (k % 2) * half, y + (k / 2) * half, half, window, range);
}

void RasterField::bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const {
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    ranges[i] = {kInfinity, kInfinity};
    if (tiles_.empty()) continue;
    Box pixels;
    bool known = true;
    // Corners, middles and the centre; what the sides bulge between them is small, and a share of the box is added for
    // it.
    for (int k = 0; k < 9; ++k) {
      const Point p = to_pixel_->at(boxes[i].centre + boxes[i].half * Point{k % 3 - 1.0, k / 3 - 1.0});
      known &= std::isfinite(p.x) && std::isfinite(p.y);
      if (known) pixels.add(p);
    }
    const double extent = known ? std::max(pixels.xmax - pixels.xmin, pixels.ymax - pixels.ymin) : 0.0;
    // A box across the seam of a raster that wraps, or beyond what the projection reaches, may hold anything.
    if (!known || (raster_.wraps && extent > 0.5 * raster_.columns)) {
      ranges[i] = {0.0, kInfinity};
      continue;
    }
    pixels = pixels.grownBy(0.05 * extent + 1e-6);
    constexpr double kFewPixels = 2.0;
    if (extent <= kFewPixels) {
      ranges[i] = boundBetween(pixels);
      continue;
    }
    pixels = pixels.grownBy(1.0);
    const std::array<std::int64_t, 4> window = {
        static_cast<std::int64_t>(std::floor(pixels.xmin)), static_cast<std::int64_t>(std::floor(pixels.ymin)),
        static_cast<std::int64_t>(std::ceil(pixels.xmax)), static_cast<std::int64_t>(std::ceil(pixels.ymax))};
    const bool within = window[0] >= (raster_.wraps ? -kTile : 0) && window[1] >= 0 &&
                        window[2] <= raster_.columns + (raster_.wraps ? kTile : 0) && window[3] <= raster_.rows;
    SizeRange range{kInfinity, within ? 0.0 : kInfinity};
    for (std::int64_t turn = raster_.wraps ? -1 : 0; turn <= (raster_.wraps ? 1 : 0); ++turn) {
      const std::int64_t shift = turn * raster_.columns;
      const auto tileOf = [](std::int64_t pixel, int low, int high) {
        return static_cast<int>(std::clamp<std::int64_t>(pixel >= 0 ? pixel / kTile : -1, low, high));
      };
      const int x0 = tileOf(window[0] + shift, window_[0], window_[2]),
                x1 = tileOf(window[2] + shift, window_[0] - 1, window_[2] - 1);
      const int y0 = tileOf(window[1], window_[1], window_[3]), y1 = tileOf(window[3], window_[1] - 1, window_[3] - 1);
      for (int row = y0; row <= y1; ++row) {
        for (int column = x0; column <= x1; ++column) {
          const Tile& tile =
              tiles_[static_cast<std::size_t>(row - window_[1]) * static_cast<std::size_t>(window_[2] - window_[0]) +
                     static_cast<std::size_t>(column - window_[0])];
          const std::int64_t x = std::int64_t{column} * kTile - shift, y = std::int64_t{row} * kTile;
          boundIn(tile, 0, 0, 0, kTile, {window[0] - x, window[1] - y, window[2] - x, window[3] - y}, range);
        }
      }
    }
    if (range.low == kInfinity) range.high = kInfinity;
    ranges[i] = range;
  }
}

void FirstOfFields::sample(std::span<const Point> places, std::span<double> sizes) const {
  std::ranges::fill(sizes, kInfinity);
  std::vector<double> own(places.size());
  for (const auto& field : fields_) {
    field->sample(places, own);
    for (std::size_t i = 0; i < sizes.size(); ++i)
      if (!std::isfinite(sizes[i])) sizes[i] = own[i];
  }
}

double FirstOfFields::least() const {
  double least = kInfinity;
  for (const auto& field : fields_) least = std::min(least, field->least());
  return least;
}

void FirstOfFields::bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const {
  std::ranges::fill(ranges, SizeRange{kInfinity, kInfinity});
  std::vector<SizeRange> own(boxes.size());
  // Up to now nothing wanted; something in a part of the box; all of it known.
  enum class Seen : char { Nothing, Part, All };
  std::vector<Seen> seen(boxes.size(), Seen::Nothing);
  for (const auto& field : fields_) {
    field->bound(boxes, own);
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      if (seen[i] == Seen::All || own[i].low == kInfinity) continue;
      const bool all = std::isfinite(own[i].high);
      ranges[i] = {std::min(ranges[i].low, own[i].low), all && seen[i] == Seen::Nothing ? own[i].high : kInfinity};
      seen[i] = all ? Seen::All : Seen::Part;
    }
  }
}

}  // namespace coastmesh
