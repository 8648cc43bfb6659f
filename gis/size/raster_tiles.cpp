#include "gis/size/raster_tiles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "gis/error.hpp"
#include "gis/raster/raster_parts.hpp"
#include "gis/size/rule_of_tiles.hpp"

namespace coastmesh {

namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();
// A cell of the quadtree is a leaf if its largest size is at most `kAlike` times the smallest, or its side at most
// `kFineShare` times that.
constexpr float kAlike = 1.04F;
constexpr double kFineShare = 0.5;
// Sizes that differ more within a leaf grow faster than the usual gradation.
constexpr float kSteep = 1.3F;
// The most rows of a margin; more are an error.
constexpr int kMostMargin = 200;

// Calls `visit(rect, shift)` for the parts of `window` in `within`, in columns of the raster. If the raster wraps
// around the Earth, these columns are `shift` further right in the window.
template <typename Visit>
void forEachPart(const PixelRect& window, const PixelRect& within, const RasterGeometry& raster, const Visit& visit) {
  for (int turn = raster.wraps ? -1 : 0; turn <= (raster.wraps ? 1 : 0); ++turn) {
    const int shift = turn * raster.columns;
    const PixelRect part = within.in(window.shifted(-shift));
    if (!part.isEmpty()) visit(part, shift);
  }
}

// Sets a tile's values to those of pixels, `at(column, row)`.
template <typename At>
void fill(RasterTile& tile, const PixelRect& tile_window, const PixelRect& part, const At& at) {
  for (int row = part.y; row < part.bottom(); ++row) {
    const std::size_t to = static_cast<std::size_t>(row - tile_window.y) * tile.stride();
    for (int column = part.x; column < part.right(); ++column)
      tile.values[to + static_cast<std::size_t>(column - tile_window.x)] = at(column, row);
  }
}

void readInto(const RasterBand& band, const PixelRect& part, const PixelRect& tile_window, RasterTile& tile) {
  const std::vector<double> values = band.read({part.x, part.y, part.width, part.height});
  fill(tile, tile_window, part, [&](int column, int row) {
    return static_cast<float>(values[static_cast<std::size_t>(row - part.y) * static_cast<std::size_t>(part.width) +
                                     static_cast<std::size_t>(column - part.x)]);
  });
}

// Reads a tile's values with its margin, as far as the raster extends: around the Earth if it wraps.
void readTile(const RasterBand& band, const TileTask& task, const PixelRect& pixels, RasterTile& tile) {
  const RasterGeometry& raster = band.geometry();
  const PixelRect window = pixels.grownBy(tile.side, tile.end);
  tile.values.assign(tile.stride() * static_cast<std::size_t>(window.height), std::nanf(""));
  PixelRect inside = window.in({window.x, 0, window.width, raster.rows});
  if (!raster.wraps) inside = inside.in({0, 0, raster.columns, raster.rows});
  if (inside.isEmpty()) return;
  if (task.own.empty()) {
    readInto(band, inside, window, tile);
    return;
  }
  for (const PixelRect& own : task.own)
    forEachPart(inside, own, raster,
                [&](const PixelRect& part, int shift) { readInto(band, part, window.shifted(-shift), tile); });
  for (const PixelPatch& patch : task.patches)
    forEachPart(inside, patch.at, raster, [&](const PixelRect& part, int shift) {
      fill(tile, window.shifted(-shift), part, [&](int column, int row) {
        return patch.values[static_cast<std::size_t>(row - patch.at.y) * static_cast<std::size_t>(patch.at.width) +
                            static_cast<std::size_t>(column - patch.at.x)];
      });
    });
}

// One level of the pyramids of the minimum, the maximum and the mean of the requested sizes of a tile.
struct PyramidLevel {
  std::vector<float> low, high, sum, count;

  explicit PyramidLevel(int side)
      : low(static_cast<std::size_t>(side) * static_cast<std::size_t>(side), kNothing),
        high(low.size(), 0.0F),
        sum(low.size(), 0.0F),
        count(low.size(), 0.0F) {}
};

// Beyond the tile nothing is requested, with `high` 0, so that cells at its end can still be uniform.
PyramidLevel levelOfPixels(const RasterTile& tile, std::span<const float> sizes) {
  PyramidLevel level(kTile);
  for (int y = 0; y < tile.height; ++y) {
    for (int x = 0; x < tile.width; ++x) {
      const float size =
          sizes[static_cast<std::size_t>(y) * static_cast<std::size_t>(tile.width) + static_cast<std::size_t>(x)];
      const std::size_t k = static_cast<std::size_t>(y) * kTile + static_cast<std::size_t>(x);
      level.low[k] = level.high[k] = size;
      if (!std::isfinite(size)) continue;
      level.sum[k] = size;
      level.count[k] = 1.0F;
    }
  }
  return level;
}

// The next level, of cells twice as wide, `side` by `side` of them; only the first `width` by `height` hold pixels.
PyramidLevel levelAbove(const PyramidLevel& fine, int side, int width, int height) {
  PyramidLevel coarse(side);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto c = static_cast<std::size_t>(y * side + x);
      for (int k = 0; k < 4; ++k) {
        const std::size_t f = static_cast<std::size_t>(2 * y + k / 2) * static_cast<std::size_t>(2 * side) +
                              static_cast<std::size_t>(2 * x + k % 2);
        coarse.low[c] = std::min(coarse.low[c], fine.low[f]);
        coarse.high[c] = std::max(coarse.high[c], fine.high[f]);
        coarse.sum[c] += fine.sum[f];
        coarse.count[c] += fine.count[f];
      }
    }
  }
  return coarse;
}

// From single pixels to the whole tile.
std::vector<PyramidLevel> pyramidOf(const RasterTile& tile, std::span<const float> sizes) {
  std::vector<PyramidLevel> levels{levelOfPixels(tile, sizes)};
  int width = tile.width, height = tile.height;
  for (int side = kTile / 2; side >= 1; side /= 2) {
    width = (width + 1) / 2;
    height = (height + 1) / 2;
    levels.push_back(levelAbove(levels.back(), side, width, height));
  }
  return levels;
}

// Turns the sizes of a tile's pixels into a quadtree whose leaves are of about one size.
SizeTile reduced(const RasterTile& tile, std::span<const float> sizes, bool keeps_least) {
  const std::vector<PyramidLevel> levels = pyramidOf(tile, sizes);
  SizeTile nodes;
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
    const PyramidLevel& level = levels[work.level];
    const int cells = kTile >> work.level;
    const std::size_t k =
        static_cast<std::size_t>(work.y) * static_cast<std::size_t>(cells) + static_cast<std::size_t>(work.x);
    const float low = level.low[k], high = level.high[k];
    const float mean = level.count[k] > 0.0F ? level.sum[k] / level.count[k] : kNothing;
    const double side_m = pixel_m * static_cast<double>(1 << work.level);
    const bool alike = high <= kAlike * low || (work.level > 0 && side_m <= kFineShare * low);
    const float value = keeps_least && alike && mean > kSteep * low ? low : mean;
    nodes[work.node] = {low, high, level.count[k] > 0.0F ? value : 0.0F, value, 0};
    if (work.level == 0 || low == kNothing || alike) {
      if (alike && low != kNothing && high != kNothing) nodes[work.node].low = nodes[work.node].high = value;
      continue;
    }
    const auto below = static_cast<std::uint32_t>(nodes.size());
    nodes[work.node].below = below;
    for (int c = 0; c < 4; ++c) {
      nodes.push_back({});
      stack.push_back({below + static_cast<std::uint32_t>(c), work.level - 1, 2 * work.x + c % 2, 2 * work.y + c / 2});
    }
  }
  for (std::size_t n = nodes.size(); n-- > 0;) {
    if (nodes[n].below == 0) continue;
    nodes[n].most = 0.0F;
    for (std::size_t c = 0; c < 4; ++c) nodes[n].most = std::max(nodes[n].most, nodes[nodes[n].below + c].most);
  }
  nodes.shrink_to_fit();
  return nodes;
}

}  // namespace

SizeTile emptyTile() { return {{kNothing, kNothing, 0.0F, kNothing, 0}}; }

std::array<int, 2> marginOf(const TilePlace& tile, double margin_m, const RasterGeometry& raster) {
  if (!(margin_m > 0.0)) return {0, 0};
  const double columns = std::ceil(margin_m / tile.pixel_m[0]), rows = std::ceil(margin_m / tile.pixel_m[1]);
  if (rows > kMostMargin)
    throw InputError(raster.path +
                     ": its pixels are too fine for a filter that long: give a coarser raster, or filter over less");
  const int most = raster.wraps ? raster.columns / 2 : raster.columns;
  return {static_cast<int>(std::min(1.0 + columns, std::max(1.0, 1.0 * most))), 1 + static_cast<int>(rows)};
}

TileAnswer answerTask(const TileTask& task) {
  std::vector<TileRule> rules;
  for (const SizeRule& rule : task.rules) rules.push_back(tileRuleOf(rule));
  return answerTask(RasterBand(task.path), task, rules);
}

TileAnswer answerTask(const RasterBand& band, const TileTask& task, std::span<const TileRule> rules) {
  requireSame(band, task.columns, task.rows);
  double margin_m = 0.0;
  for (const TileRule& rule : rules) margin_m = std::max(margin_m, rule.margin_m);
  TileAnswer answer;
  answer.tiles.resize(rules.size());
  RasterTile tile;
  tile.file = task.path;
  std::vector<float> sizes;
  for (const TilePlace& place : task.tiles) {
    tile.width = place.pixels.width;
    tile.height = place.pixels.height;
    tile.pixel_m[0] = place.pixel_m[0];
    tile.pixel_m[1] = place.pixel_m[1];
    const auto [side, end] = marginOf(place, margin_m, band.geometry());
    tile.side = side;
    tile.end = end;
    readTile(band, task, place.pixels, tile);
    for (std::size_t r = 0; r < rules.size(); ++r) {
      sizes.assign(static_cast<std::size_t>(tile.width) * static_cast<std::size_t>(tile.height), kNothing);
      rules[r].sizes(tile, sizes);
      answer.tiles[r].push_back(reduced(tile, sizes, rules[r].keeps_least));
    }
  }
  for (const PixelRect& strip : task.strips) {
    const std::vector<double> values = band.read({strip.x, strip.y, strip.width, strip.height});
    answer.strips.push_back({strip, {values.begin(), values.end()}});
  }
  answer.use = band.use();
  return answer;
}

}  // namespace coastmesh
