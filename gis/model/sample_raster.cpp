#include "gis/model/sample_raster.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include "gis/crs/crs_map.hpp"
#include "gis/crs/ogr_support.hpp"

namespace coastmesh {
namespace {

struct Tile {
  std::int64_t row = 0;
  std::int64_t column = 0;

  friend auto operator<=>(const Tile&, const Tile&) = default;
};

Tile tileAt(const RasterBand& raster, std::int64_t column, std::int64_t row) {
  return {row / raster.tileRows(), column / raster.tileColumns()};
}

void stopIfAsked(const RunControl& control) {
  if (control.cancelled && control.cancelled()) throw Cancelled();
}

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
  if (!inside) return std::nullopt;  // also what is not finite
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

// A place in the raster, by its number.
struct Visit {
  Tile tile;
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
  // The first visit after `k` to another tile.
  std::size_t endOfTile(std::size_t k) const {
    std::size_t end = k;
    while (end < in_order_.size() && in_order_[end].tile == in_order_[k].tile) ++end;
    return end;
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
  // One pixel of a visit, or up to four that lie side by side: which of the four is the first.
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
  constexpr std::size_t kMostWindows = 1 << 16;  // of a task
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

// Of one tile's visits, `first` up to `last`.
void sampleTile(const RasterBand& raster, const Visits& visits, std::size_t first, std::size_t last,
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
    samples[visits[k].index] = blend(four, corner);
  }
}

// Shares of the tiles are read at once, each by a raster of its own: GDAL's are for one thread.
void sampleHere(const RasterBand& raster, const Visits& visits, const ItemLoop& loop, const RunControl& control,
                std::vector<RasterSample>& samples) {
  constexpr std::size_t kMostShares = 16, kWorthAShare = 1 << 15;
  std::vector<std::size_t> ends;
  const std::size_t length = std::max(kWorthAShare, visits.size() / kMostShares + 1);
  for (std::size_t begin = 0, end = 0; begin < visits.size(); begin = end) {
    end = visits.endOfTile(std::min(begin + length, visits.size()) - 1);
    ends.push_back(end);
  }
  loop(ends.size(), [&](std::size_t s) {
    std::optional<RasterBand> own;
    if (ends.size() > 1) own.emplace(raster.path());
    for (std::size_t first = s == 0 ? 0 : ends[s - 1], last = 0; first < ends[s]; first = last) {
      stopIfAsked(control);
      last = visits.endOfTile(first);
      sampleTile(own ? *own : raster, visits, first, last, samples);
    }
  });
}

}  // namespace

std::vector<Point> pixelsOf(const Grid& grid, const RasterBand& raster, const ItemLoop& loop) {
  const bool as_is = grid.crs.isPlane() || raster.crs().isPlane() || sameCrs(grid.crs, raster.crs());
  std::optional<CrsMap> map;
  if (!as_is) map.emplace(toOgr(grid.crs), toOgr(raster.crs()));
  // A raster without a CRS does not know that its columns are longitudes.
  const bool tries_turns = grid.crs.geographic && raster.crs().isPlane();
  const auto isInside = [&raster](const Point& pixel) {
    return pixel.x >= 0.0 && pixel.x <= static_cast<double>(raster.columns());
  };
  const auto pixelOf = [&](const Point& node) {
    const Point pixel = raster.pixelOf(map ? map->forward(node) : node);
    if (!tries_turns || isInside(pixel)) return pixel;
    for (const double turn : {-360.0, 360.0})
      if (const Point turned = raster.pixelOf({node.x + turn, node.y}); isInside(turned)) return turned;
    return pixel;
  };
  std::vector<Point> pixels;
  reserveOn(loop, pixels, grid.nodes.size());
  pixels.resize(grid.nodes.size());
  forEachByStretches(loop, pixels.size(), [&](std::size_t i) { pixels[i] = pixelOf(grid.nodes[i]); });
  return pixels;
}

std::vector<RasterSample> sampleBilinear(const RasterBand& raster, std::span<const Point> pixels,
                                         std::span<const std::uint32_t> which, const PixelReaders* readers,
                                         const ItemLoop& loop, const RunControl& control) {
  const Visits visits(raster, pixels, which, loop);
  std::vector<RasterSample> samples(which.size());
  if (readers == nullptr || !raster.geometry().is_exact) {
    sampleHere(raster, visits, loop, control, samples);
    return samples;
  }
  const std::vector<std::array<double, 4>> corners = cornersByReaders(raster, visits, *readers, loop);
  for (std::size_t k = 0; k < visits.size(); ++k) samples[visits[k].index] = blend(corners[k], visits.corner(k));
  return samples;
}

namespace {

// A triangle in pixels, its corners in one turn of longitudes.
using PixelTriangle = std::array<Point, 3>;

std::optional<PixelTriangle> pixelTriangle(const RasterBand& raster, std::span<const Point> pixels,
                                           const std::array<std::uint32_t, 3>& nodes) {
  PixelTriangle corners;
  for (unsigned i = 0; i < 3; ++i) {
    corners[i] = pixels[nodes[i]];
    if (!std::isfinite(corners[i].x) || !std::isfinite(corners[i].y)) return std::nullopt;
    if (raster.period() > 0.0)
      corners[i].x += raster.period() * std::round((corners[0].x - corners[i].x) / raster.period());
  }
  return corners;
}

// Where the row's line of centres crosses the edge; the same for both triangles at the edge.
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
  std::int64_t left = 0, right = 0, top = 0, bottom = 0;  // up to, without, right and bottom
};

// A triangle and a tile that hold pixels in common.
struct Overlap {
  Tile tile;
  std::uint32_t triangle = 0;
  std::int64_t shift = 0;  // columns to be added to the triangle's

  auto key() const { return std::tuple(tile, triangle, shift); }
};

class AverageSampler {
 public:
  AverageSampler(const RasterBand& raster, const Grid& grid, std::span<const Point> pixels)
      : raster_(raster), grid_(grid), pixels_(pixels), sums_(grid.triangles.size()) {}

  void run(const std::vector<bool>& wanted, double least_pixels, const RunControl& control) {
    findOverlaps(wanted, least_pixels);
    for (std::size_t begin = 0, end = 0; begin < overlaps_.size(); begin = end) {
      stopIfAsked(control);
      end = begin;
      while (end < overlaps_.size() && overlaps_[end].tile == overlaps_[begin].tile) ++end;
      addTile(begin, end);
    }
  }

  struct Sum {
    double sum = 0.0;
    double values = 0.0;  // pixels with a value
    double pixels = 0.0;  // of the triangle's area
  };
  const Sum& sumOf(std::size_t triangle) const { return sums_[triangle]; }

 private:
  PixelBox boxOf(const PixelTriangle& corners, std::int64_t shift) const {
    const auto [west, east] = std::minmax({corners[0].x, corners[1].x, corners[2].x});
    const auto [north, south] = std::minmax({corners[0].y, corners[1].y, corners[2].y});
    // Clamped before it is made whole: a corner may lie anywhere.
    const auto whole = [](double x, std::int64_t most) {
      return firstCentre(std::clamp(x, 0.0, static_cast<double>(most) + 1.0));
    };
    const auto s = static_cast<double>(shift);
    return {whole(west + s, raster_.columns()), std::min(whole(east + s, raster_.columns()), raster_.columns()),
            whole(north, raster_.rows()), std::min(whole(south, raster_.rows()), raster_.rows())};
  }

  void findOverlaps(const std::vector<bool>& wanted, double least_pixels) {
    std::vector<double> pixels_round(grid_.nodes.size(), 0.0);
    for (std::size_t t = 0; t < grid_.triangles.size(); ++t) {
      const auto corners = pixelTriangle(raster_, pixels_, grid_.triangles[t]);
      if (!corners) continue;
      sums_[t].pixels = areaOf(*corners);
      for (const std::uint32_t node : grid_.triangles[t]) pixels_round[node] += sums_[t].pixels;
    }
    for (std::uint32_t t = 0; t < grid_.triangles.size(); ++t) {
      const auto& nodes = grid_.triangles[t];
      const auto counts = [&](std::uint32_t node) { return wanted[node] && pixels_round[node] >= least_pixels; };
      if (std::ranges::none_of(nodes, counts)) continue;
      const auto corners = pixelTriangle(raster_, pixels_, nodes);
      if (!corners) continue;
      addOverlaps(t, *corners, 0);
      if (!raster_.wraps()) continue;
      addOverlaps(t, *corners, raster_.columns());
      addOverlaps(t, *corners, -raster_.columns());
    }
    std::ranges::sort(overlaps_, {}, &Overlap::key);
  }

  void addOverlaps(std::uint32_t t, const PixelTriangle& corners, std::int64_t shift) {
    const PixelBox box = boxOf(corners, shift);
    if (box.left >= box.right || box.top >= box.bottom) return;
    const Tile first = tileAt(raster_, box.left, box.top), last = tileAt(raster_, box.right - 1, box.bottom - 1);
    for (std::int64_t row = first.row; row <= last.row; ++row)
      for (std::int64_t column = first.column; column <= last.column; ++column)
        overlaps_.push_back({{row, column}, t, shift});
  }

  void addTile(std::size_t begin, std::size_t end) {
    const Tile& tile = overlaps_[begin].tile;
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
      const PixelBox box =
          inTile(overlaps_[k], *pixelTriangle(raster_, pixels_, grid_.triangles[overlaps_[k].triangle]));
      part = {std::min(part.left, box.left), std::max(part.right, box.right), std::min(part.top, box.top),
              std::max(part.bottom, box.bottom)};
    }
    if (part.left >= part.right || part.top >= part.bottom) return;
    const RasterWindow window{part.left, part.top, part.right - part.left, part.bottom - part.top};
    const std::vector<double> values = raster_.read(window);
    for (std::size_t k = begin; k < end; ++k) {
      const Overlap& overlap = overlaps_[k];
      PixelTriangle corners = *pixelTriangle(raster_, pixels_, grid_.triangles[overlap.triangle]);
      const PixelBox box = inTile(overlap, corners);
      for (Point& corner : corners) corner.x += static_cast<double>(overlap.shift);
      Sum& sum = sums_[overlap.triangle];
      forEachRow(corners, box.top, box.bottom, [&](std::int64_t from, std::int64_t to, std::int64_t row) {
        const std::int64_t line = (row - window.row) * window.columns - window.column;
        for (std::int64_t c = std::max(from, whole.left); c < std::min(to, whole.right); ++c) {
          const double value = values[static_cast<std::size_t>(line + c)];
          if (std::isnan(value)) continue;
          sum.sum += value;
          sum.values += 1.0;
        }
      });
    }
  }

  const RasterBand& raster_;
  const Grid& grid_;
  std::span<const Point> pixels_;
  std::vector<Sum> sums_;
  std::vector<Overlap> overlaps_;
};

}  // namespace

std::vector<RasterSample> sampleAverage(const RasterBand& raster, const Grid& grid, std::span<const Point> pixels,
                                        std::span<const std::uint32_t> which, double least_pixels,
                                        const RunControl& control) {
  std::vector<bool> wanted(grid.nodes.size(), false);
  for (const std::uint32_t node : which) wanted[node] = true;
  AverageSampler sampler(raster, grid, pixels);
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
