#include "gis/size/size_raster.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "core/metric.hpp"
#include "gis/size/read_frames.hpp"

namespace coastmesh {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr float kNothing = std::numeric_limits<float>::infinity();
constexpr double kSteepShare = 0.6;
// Sides of a box bulge between places that are computed: by this share of its extent, and a few roundings.
constexpr double kBulge = 0.05, kHair = 1e-6;  // pixels

std::array<std::int64_t, 4> windowAround(const Box& pixels) {
  const Box grown = pixels.grownBy(1.0);
  return {static_cast<std::int64_t>(std::floor(grown.xmin)), static_cast<std::int64_t>(std::floor(grown.ymin)),
          static_cast<std::int64_t>(std::ceil(grown.xmax)), static_cast<std::int64_t>(std::ceil(grown.ymax))};
}

}  // namespace

RasterField::RasterField(const RasterGeometry& raster, const Crs& input, const Projection& projection, const Box& box,
                         const TileRule& rule, const ItemLoop& loop)
    : frame_(std::make_shared<RasterFrame>(raster, input, projection, box, loop)),
      tiles_(std::move(readFrames(std::span(&frame_, 1), std::span(&rule, 1), loop).front().front())) {
  findLeast();
}

RasterField::RasterField(std::shared_ptr<const RasterFrame> frame, std::vector<SizeTile>&& tiles)
    : frame_(std::move(frame)), tiles_(std::move(tiles)) {
  findLeast();
}

void RasterField::findLeast() {
  for (const SizeTile& tile : tiles_) least_ = std::min(least_, static_cast<double>(tile.front().low));
}

// The size at a pixel; infinite outside the tiles.
float RasterField::pixel(std::int64_t x, std::int64_t y) const {
  const RasterFrame& frame = *frame_;
  if (frame.raster.wraps) x = (x % frame.raster.columns + frame.raster.columns) % frame.raster.columns;
  if (x < 0 || y < 0) return kNothing;
  const int column = frame.columns.tileOf(static_cast<int>(x)), row = frame.rows.tileOf(static_cast<int>(y));
  if (!frame.has(column, row)) return kNothing;
  const SizeTile& tile = tiles_[frame.numberOf(column, row)];
  const int in_x = static_cast<int>(x) - frame.columns.start(column);
  const int in_y = static_cast<int>(y) - frame.rows.start(row);
  std::uint32_t node = 0;
  for (int half = kTile / 2; tile[node].below != 0; half /= 2)
    node = tile[node].below + ((in_x & half) != 0 ? 1 : 0) + ((in_y & half) != 0 ? 2 : 0);
  return tile[node].value;
}

void RasterField::sample(std::span<const Point> places, std::span<double> sizes) const {
  for (std::size_t i = 0; i < places.size(); ++i) {
    sizes[i] = kInfinity;
    if (tiles_.empty()) continue;
    const Point p = frame_->pixelOf(places[i]);
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) continue;
    // Up to half a pixel beyond the last centres, the nearest one is used.
    if (!frame_->raster.wraps && (p.x < 0.0 || p.x > frame_->raster.columns)) continue;
    if (p.y < 0.0 || p.y > frame_->raster.rows) continue;
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
    // A size much smaller than those around it applies to its whole pixel: interpolation between centres would almost
    // lose it.
    const float own = pixel(static_cast<std::int64_t>(std::floor(p.x)), static_cast<std::int64_t>(std::floor(p.y)));
    if (own < kSteepShare * sizes[i]) sizes[i] = own;
  }
}

// Bounds of what `sample` returns in a box of a few pixels, given in pixels. Lines through pixel centres and along
// pixel edges divide the box into cells where sizes are bilinear or a pixel's own, so that corners bound them. The
// bounds of all pixels nearby would be much too wide if one size is much smaller than those around it.
SizeRange RasterField::boundBetween(const Box& pixels) const {
  const RasterGeometry& raster = frame_->raster;
  if (pixels.ymax < 0.0 || pixels.ymin > raster.rows) return {kInfinity, kInfinity};
  if (!raster.wraps && (pixels.xmax < 0.0 || pixels.xmin > raster.columns)) return {kInfinity, kInfinity};
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
      if ((!raster.wraps && (x < 0.0 || x > raster.columns)) || y < 0.0 || y > raster.rows) {
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

void RasterField::boundIn(const SizeTile& tile, std::uint32_t node, int x, int y, int side, const PixelWindow& window,
                          SizeRange& range) const {
  const SizeNode& n = tile[node];
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

double RasterField::mostKnownIn(const SizeTile& tile, std::uint32_t node, int x, int y, int side,
                                const PixelWindow& window, double most) const {
  const SizeNode& n = tile[node];
  if (n.most <= most) return most;
  if (x >= window[2] || y >= window[3] || x + side <= window[0] || y + side <= window[1]) return most;
  const bool covered = x >= window[0] && y >= window[1] && x + side <= window[2] && y + side <= window[3];
  if (covered || n.below == 0) return n.most;
  const int half = side / 2;
  for (int k = 0; k < 4; ++k)
    most = mostKnownIn(tile, n.below + static_cast<std::uint32_t>(k), x + (k % 2) * half, y + (k / 2) * half, half,
                       window, most);
  return most;
}

// The pixels that meet a box, in columns beyond the first or last one across the seam of a raster that wraps;
// nullopt for a box around a pole, over half of such a raster, or beyond the reach of the projection, which may contain
// any.
std::optional<Box> RasterField::pixelsIn(const SizeBox& box) const {
  const RasterGeometry& raster = frame_->raster;
  Box pixels;
  // Corners and midpoints of sides, around the box, then the centre.
  constexpr std::array<Point, 9> kPlaces{
      {{-1, -1}, {0, -1}, {1, -1}, {1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {0, 0}}};
  double first = 0.0, last = 0.0;
  const auto besideLast = [&](double x) { return last + std::remainder(x - last, raster.columns); };
  for (std::size_t k = 0; k < kPlaces.size(); ++k) {
    Point p = frame_->pixelOf(box.centre + box.half * kPlaces[k]);
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) return std::nullopt;
    if (raster.wraps && k > 0) p.x = besideLast(p.x);
    if (k == 0) first = p.x;
    if (raster.wraps && k == kPlaces.size() - 2 &&
        std::abs(first + std::remainder(p.x - first, raster.columns) - p.x) > 1.0)
      return std::nullopt;
    last = p.x;
    pixels.add(p);
  }
  const double extent = std::max(pixels.xmax - pixels.xmin, pixels.ymax - pixels.ymin);
  if (raster.wraps && extent > 0.5 * raster.columns) return std::nullopt;
  return pixels.grownBy(kBulge * extent + kHair);
}

// Calls `found(tile, window)` for the tiles that meet these pixels and their neighbours, with the window in the tile's
// own pixels.
template <typename Found>
void RasterField::forTiles(const PixelWindow& window, Found&& found) const {
  const RasterGeometry& raster = frame_->raster;
  for (std::int64_t turn = raster.wraps ? -1 : 0; turn <= (raster.wraps ? 1 : 0); ++turn) {
    const std::int64_t shift = turn * raster.columns;
    const auto tileOf = [](const TileAxis& axis, std::int64_t pixel, int low, int high) {
      return std::clamp(pixel < 0 ? -1 : axis.tileOf(static_cast<int>(std::min<std::int64_t>(pixel, axis.pixels()))),
                        low, high);
    };
    const std::array<int, 4>& kept = frame_->window;
    const int x0 = tileOf(frame_->columns, window[0] + shift, kept[0], kept[2]),
              x1 = tileOf(frame_->columns, window[2] + shift, kept[0] - 1, kept[2] - 1);
    const int y0 = tileOf(frame_->rows, window[1], kept[1], kept[3]),
              y1 = tileOf(frame_->rows, window[3], kept[1] - 1, kept[3] - 1);
    for (int row = y0; row <= y1; ++row) {
      for (int column = x0; column <= x1; ++column) {
        const std::int64_t x = frame_->columns.start(column) - shift, y = frame_->rows.start(row);
        found(tiles_[frame_->numberOf(column, row)],
              PixelWindow{window[0] - x, window[1] - y, window[2] - x, window[3] - y});
      }
    }
  }
}

void RasterField::bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const {
  const RasterGeometry& raster = frame_->raster;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    ranges[i] = {kInfinity, kInfinity};
    if (tiles_.empty()) continue;
    const std::optional<Box> pixels = pixelsIn(boxes[i]);
    if (!pixels) {
      ranges[i] = {least_, kInfinity};
      continue;
    }
    constexpr double kFewPixels = 2.0 * (1.0 + 2.0 * kBulge) + 2.0 * kHair;  // two, with what was added
    if (std::max(pixels->xmax - pixels->xmin, pixels->ymax - pixels->ymin) <= kFewPixels) {
      ranges[i] = boundBetween(*pixels);
      continue;
    }
    const PixelWindow window = windowAround(*pixels);
    const bool within = window[0] >= (raster.wraps ? -kTile : 0) && window[1] >= 0 &&
                        window[2] <= raster.columns + (raster.wraps ? kTile : 0) && window[3] <= raster.rows;
    SizeRange range{kInfinity, within ? 0.0 : kInfinity};
    forTiles(window, [&](const SizeTile& tile, const PixelWindow& own) { boundIn(tile, 0, 0, 0, kTile, own, range); });
    if (range.low == kInfinity) range.high = kInfinity;
    ranges[i] = range;
  }
}

double RasterField::mostIn(const SizeBox& box) const {
  if (tiles_.empty()) return 0.0;
  const std::optional<Box> pixels = pixelsIn(box);
  double most = 0.0;
  if (!pixels) {
    for (const SizeTile& tile : tiles_) most = std::max(most, static_cast<double>(tile.front().most));
    return most;
  }
  forTiles(windowAround(*pixels),
           [&](const SizeTile& tile, const PixelWindow& own) { most = mostKnownIn(tile, 0, 0, 0, kTile, own, most); });
  return most;
}

void FirstOfFields::sample(std::span<const Point> places, std::span<double> sizes) const {
  std::ranges::fill(sizes, kInfinity);
  std::vector<double> own(places.size()), known(coverage_.empty() ? 0 : places.size());
  std::vector<char> settled(places.size(), 0);
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    fields_[f]->sample(places, own);
    if (!coverage_.empty()) coverage_[f]->sample(places, known);
    const std::vector<double>& covers = coverage_.empty() ? own : known;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      if (settled[i] != 0 || !std::isfinite(covers[i])) continue;
      sizes[i] = own[i];
      settled[i] = 1;
    }
  }
}

double FirstOfFields::mostIn(const SizeBox& box) const {
  double most = 0.0;
  for (const auto& field : fields_) most = std::max(most, field->mostIn(box));
  return most;
}

double FirstOfFields::least() const {
  double least = kInfinity;
  for (const auto& field : fields_) least = std::min(least, field->least());
  return least;
}

void FirstOfFields::bound(std::span<const SizeBox> boxes, std::span<SizeRange> ranges) const {
  std::ranges::fill(ranges, SizeRange{kInfinity, kInfinity});
  std::vector<SizeRange> own(boxes.size()), known(coverage_.empty() ? 0 : boxes.size());
  // The part of a box covered by the fields so far.
  enum class Seen : char { Nothing, Part, All };
  std::vector<Seen> seen(boxes.size(), Seen::Nothing);
  for (std::size_t f = 0; f < fields_.size(); ++f) {
    fields_[f]->bound(boxes, own);
    if (!coverage_.empty()) coverage_[f]->bound(boxes, known);
    const std::vector<SizeRange>& covers = coverage_.empty() ? own : known;
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      if (seen[i] == Seen::All || covers[i].low == kInfinity) continue;
      const bool all = std::isfinite(covers[i].high);
      ranges[i] = {std::min(ranges[i].low, own[i].low), all && seen[i] == Seen::Nothing ? own[i].high : kInfinity};
      seen[i] = all ? Seen::All : Seen::Part;
    }
  }
}

}  // namespace coastmesh
