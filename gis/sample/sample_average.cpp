#include "gis/sample/sample_average.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "gis/raster/raster_turn.hpp"
#include "gis/sample/stored_tiles.hpp"

namespace coastmesh {
namespace {

// A triangle in pixels, with unwrapped longitudes.
using PixelTriangle = std::array<Point, 3>;

// `turn`: see `columnsOfTurn`.
std::optional<PixelTriangle> pixelTriangle(double turn, std::span<const Point> pixels,
                                           const std::array<std::uint32_t, 3>& nodes) {
  PixelTriangle corners;
  for (unsigned i = 0; i < 3; ++i) {
    corners[i] = pixels[nodes[i]];
    if (!std::isfinite(corners[i].x) || !std::isfinite(corners[i].y)) return std::nullopt;
    if (turn > 0.0) corners[i].x += turn * std::round((corners[0].x - corners[i].x) / turn);
  }
  return corners;
}

// The x at which the line of a row's centres crosses an edge; the same for both triangles at the edge.
double crossing(Point a, Point b, double y) {
  if (std::tuple(b.y, b.x) < std::tuple(a.y, a.x)) std::swap(a, b);
  return a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x);
}

// The first pixel whose centre is not left of `x`.
std::int64_t firstCentre(double x) { return static_cast<std::int64_t>(std::ceil(x - 0.5)); }

// Calls `use(column from, column to, row)` for each row of pixels whose centres lie in the triangle; a centre on an
// edge belongs to one of the two triangles there.
void forEachRow(const PixelTriangle& corners, std::int64_t top, std::int64_t bottom, auto&& use) {
  for (std::int64_t row = top; row < bottom; ++row) {
    const double y = static_cast<double>(row) + 0.5;
    double left = std::numeric_limits<double>::infinity(), right = -left;
    for (unsigned i = 0; i < 3; ++i) {
      const Point &a = corners[i], &b = corners[(i + 1) % 3];
      if ((a.y <= y) == (b.y <= y)) continue;
      const double x = crossing(a, b, y);
      left = std::min(left, x);
      right = std::max(right, x);
    }
    if (left < right) use(firstCentre(left), firstCentre(right), row);
  }
}

double areaOf(const PixelTriangle& c) {
  return std::abs((c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[2].x - c[0].x) * (c[1].y - c[0].y)) / 2.0;
}

struct PixelBox {
  std::int64_t left = 0, right = 0, top = 0, bottom = 0;  // right and bottom excluded
};

// A triangle and a tile with common pixels.
struct Overlap {
  StoredTile tile;
  std::uint32_t triangle = 0;
  std::int64_t shift = 0;  // columns to be added to the triangle's
  double sum = 0.0;        // over its pixels in the tile that have a value
  double values = 0.0;     // their number
  // The first of its pixels whose class has no value.
  std::optional<std::pair<std::int64_t, std::int64_t>> lacking{};

  auto operator<=>(const Overlap& other) const {
    return std::tie(tile, triangle, shift) <=> std::tie(other.tile, other.triangle, other.shift);
  }
};

class AverageSampler {
 public:
  AverageSampler(const RasterBand& raster, const Grid& grid, std::span<const Point> pixels, const PixelClasses* classes,
                 const ItemLoop& loop)
      : raster_(raster),
        grid_(grid),
        pixels_(pixels),
        classes_(classes),
        loop_(loop),
        turn_(columnsOfTurn(raster.geometry(), grid.crs)),
        sums_(grid.triangles.size()) {}

  void run(const std::vector<bool>& wanted, double least_pixels, const RunControl& control) {
    findOverlaps(wanted, least_pixels);
    const std::vector<std::size_t> ends =
        endsOfTiles(overlaps_.size(), [this](std::size_t k) { return overlaps_[k].tile; });
    constexpr std::size_t kWorthAShare = 1 << 11;
    forEachTile(raster_, ends, kWorthAShare, loop_, control,
                [&](const RasterBand& raster, std::size_t first, std::size_t last) { addTile(raster, first, last); });
    // Added one after another, for the same sums with any number of threads.
    for (const Overlap& overlap : overlaps_) {
      if (overlap.lacking) classes_->failAt(raster_, overlap.lacking->first, overlap.lacking->second);
      sums_[overlap.triangle].sum += overlap.sum;
      sums_[overlap.triangle].values += overlap.values;
    }
  }

  struct Sum {
    double sum = 0.0;
    double values = 0.0;  // pixels with a value
    double pixels = 0.0;  // the triangle's area
  };
  const Sum& sumOf(std::size_t triangle) const { return sums_[triangle]; }

 private:
  std::optional<PixelTriangle> triangleOf(std::size_t t) const {
    return pixelTriangle(turn_, pixels_, grid_.triangles[t]);
  }

  // True if the raster covers all longitudes, to half a pixel.
  bool coversTurn() const { return turn_ > 0.0 && static_cast<double>(raster_.columns()) > turn_ - 0.5; }

  PixelBox boxOf(const PixelTriangle& corners, std::int64_t shift) const {
    const auto [west, east] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
    const auto [north, south] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
    // Clamped before conversion to an integer: a corner may lie anywhere.
    const auto whole = [](double x, std::int64_t most) {
      return firstCentre(std::clamp(x, 0.0, static_cast<double>(most) + 1.0));
    };
    const auto s = static_cast<double>(shift);
    return {whole(west + s, raster_.columns()), std::min(whole(east + s, raster_.columns()), raster_.columns()),
            whole(north, raster_.rows()), std::min(whole(south, raster_.rows()), raster_.rows())};
  }

  void findOverlaps(const std::vector<bool>& wanted, double least_pixels) {
    forEachByStretches(loop_, grid_.triangles.size(), [&](std::size_t t) {
      if (const auto corners = triangleOf(t)) sums_[t].pixels = areaOf(*corners);
    });
    std::vector<double> pixels_round(grid_.nodes.size(), 0.0);
    for (std::size_t t = 0; t < grid_.triangles.size(); ++t)
      for (const std::uint32_t node : grid_.triangles[t]) pixels_round[node] += sums_[t].pixels;
    const auto counts = [&](std::uint32_t node) { return wanted[node] && pixels_round[node] >= least_pixels; };
    overlaps_ = joined(overStretches(loop_, grid_.triangles.size(), [&](std::size_t first, std::size_t last) {
      std::vector<Overlap> some;
      for (std::size_t t = first; t < last; ++t) {
        const auto& nodes = grid_.triangles[t];
        if (std::ranges::none_of(nodes, counts)) continue;
        const auto corners = triangleOf(t);
        if (!corners) continue;
        const auto number = static_cast<std::uint32_t>(t);
        addOverlaps(number, *corners, 0, some);
        if (!coversTurn()) continue;
        addOverlaps(number, *corners, std::llround(turn_), some);
        addOverlaps(number, *corners, -std::llround(turn_), some);
      }
      return some;
    }));
    sortOn(loop_, overlaps_);
  }

  void addOverlaps(std::uint32_t t, const PixelTriangle& corners, std::int64_t shift,
                   std::vector<Overlap>& overlaps) const {
    const PixelBox box = boxOf(corners, shift);
    if (box.left >= box.right || box.top >= box.bottom) return;
    const StoredTile first = tileAt(raster_, box.left, box.top), last = tileAt(raster_, box.right - 1, box.bottom - 1);
    for (std::int64_t row = first.row; row <= last.row; ++row)
      for (std::int64_t column = first.column; column <= last.column; ++column)
        overlaps.push_back({.tile = {row, column}, .triangle = t, .shift = shift});
  }

  void addTile(const RasterBand& raster, std::size_t begin, std::size_t end) {
    const StoredTile& tile = overlaps_[begin].tile;
    const PixelBox whole{tile.column * raster_.tileColumns(),
                         std::min((tile.column + 1) * raster_.tileColumns(), raster_.columns()),
                         tile.row * raster_.tileRows(), std::min((tile.row + 1) * raster_.tileRows(), raster_.rows())};
    PixelBox part{whole.right, whole.left, whole.bottom, whole.top};
    const auto inTile = [&](const Overlap& overlap, const PixelTriangle& corners) {
      const PixelBox box = boxOf(corners, overlap.shift);
      return PixelBox{std::max(box.left, whole.left), std::min(box.right, whole.right), std::max(box.top, whole.top),
                      std::min(box.bottom, whole.bottom)};
    };
    for (std::size_t k = begin; k < end; ++k) {
      const PixelBox box = inTile(overlaps_[k], *triangleOf(overlaps_[k].triangle));
      part = {std::min(part.left, box.left), std::max(part.right, box.right), std::min(part.top, box.top),
              std::max(part.bottom, box.bottom)};
    }
    if (part.left >= part.right || part.top >= part.bottom) return;
    const RasterWindow window{part.left, part.top, part.right - part.left, part.bottom - part.top};
    const std::vector<double> values = raster.read(window);
    for (std::size_t k = begin; k < end; ++k) {
      Overlap& overlap = overlaps_[k];
      PixelTriangle corners = *triangleOf(overlap.triangle);
      const PixelBox box = inTile(overlap, corners);
      for (Point& corner : corners) corner.x += static_cast<double>(overlap.shift);
      forEachRow(corners, box.top, box.bottom, [&](std::int64_t from, std::int64_t to, std::int64_t row) {
        const std::int64_t line = (row - window.row) * window.columns - window.column;
        for (std::int64_t c = std::max(from, whole.left); c < std::min(to, whole.right); ++c) {
          double value = values[static_cast<std::size_t>(line + c)];
          if (std::isnan(value)) continue;
          if (classes_ != nullptr) {
            const std::optional<double> meant = classes_->valueOf(value);
            if (!meant && !overlap.lacking) overlap.lacking = {c, row};
            if (!meant) continue;
            value = *meant;
          }
          overlap.sum += value;
          overlap.values += 1.0;
        }
      });
    }
  }

  const RasterBand& raster_;
  const Grid& grid_;
  std::span<const Point> pixels_;
  const PixelClasses* classes_;
  const ItemLoop& loop_;
  double turn_;            // see `columnsOfTurn`; 0: none
  std::vector<Sum> sums_;  // of each triangle
  std::vector<Overlap> overlaps_;
};

}  // namespace

std::vector<RasterSample> sampleAverage(const RasterBand& raster, const Grid& grid, std::span<const Point> pixels,
                                        std::span<const std::uint32_t> which, double least_pixels, const ItemLoop& loop,
                                        const RunControl& control, const PixelClasses* classes) {
  std::vector<bool> wanted(grid.nodes.size(), false);
  for (const std::uint32_t node : which) wanted[node] = true;
  AverageSampler sampler(raster, grid, pixels, classes, loop);
  sampler.run(wanted, least_pixels, control);
  std::vector<AverageSampler::Sum> at_node(grid.nodes.size());
  for (std::size_t t = 0; t < grid.triangles.size(); ++t) {
    const auto& part = sampler.sumOf(t);
    for (const std::uint32_t node : grid.triangles[t]) {
      at_node[node].sum += part.sum;
      at_node[node].values += part.values;
      at_node[node].pixels += part.pixels;
    }
  }
  std::vector<RasterSample> samples;
  for (const std::uint32_t node : which) {
    const auto& sum = at_node[node];
    const bool enough = sum.pixels >= least_pixels && sum.values > 0.0;
    samples.push_back(enough ? RasterSample{sum.sum / sum.values, std::min(1.0, sum.values / sum.pixels)}
                             : RasterSample{});
  }
  return samples;
}

}  // namespace coastmesh
