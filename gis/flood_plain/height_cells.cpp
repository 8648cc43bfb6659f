#include "gis/flood_plain/height_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <utility>

#include "core/metric.hpp"
#include "gis/coast/box_of_frame.hpp"
#include "gis/coast/feature_bounds.hpp"
#include "gis/crs/crs_map.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"
#include "gis/raster/raster_band.hpp"
#include "gis/sample/sample_raster.hpp"

namespace coastmesh {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kMostCells = 32e6;
constexpr double kAround = 2.0;                // cells around the frame
constexpr double kShareOfElement = 1.0 / 3.0;  // the largest cell, if pixels are smaller
constexpr std::size_t kMostSamples = 3;        // in a cell, along each axis

// The place of a raster's edges in the coastline's CRS.
Box extentOf(const RasterBand& raster, const Crs& crs) {
  constexpr int kPieces = 16;  // of a side
  const bool as_is = crs.isPlane() || raster.crs().isPlane() || sameCrs(crs, raster.crs());
  std::optional<CrsMap> map;
  if (!as_is) map.emplace(toOgr(raster.crs()), toOgr(crs));
  Box box;
  for (int i = 0; i <= kPieces; ++i) {
    const double x = static_cast<double>(raster.columns()) * i / kPieces;
    const double y = static_cast<double>(raster.rows()) * i / kPieces;
    for (const Point& pixel : {Point{x, 0.0}, Point{x, static_cast<double>(raster.rows())}, Point{0.0, y},
                               Point{static_cast<double>(raster.columns()), y}}) {
      const Point place = raster.geometry().placeOf(pixel);
      const Point seen = map ? map->forward(place) : place;
      if (std::isfinite(seen.x) && std::isfinite(seen.y)) box.add(seen);
    }
  }
  return box;
}

// Where land is sought.
Box searchedBox(const Coastline& coastline, const std::vector<RasterBand>& rasters) {
  Box box = boundsOfFrames(coastline);
  if (box.empty())
    for (const RasterBand& raster : rasters) {
      const Box extent = extentOf(raster, coastline.crs);
      if (!extent.empty()) box.add(extent);
    }
  if (box.empty())
    throw InputError("--flood-height: no raster of --bathymetry has a place in " + nameOf(coastline.crs) +
                     ": is its CRS right?");
  constexpr double kWidest = 180.0;  // degrees
  if (coastline.crs.geographic && box.xmax - box.xmin > kWidest)
    throw InputError("--flood-height: the land to be searched reaches over " + inWords(box) +
                     ": give a frame of at most 180 degrees; one across the antimeridian needs an input whose "
                     "longitudes go on past 180");
  return box;
}

// A pixel in units of the coastline's CRS at the middle of the box, and the shares of a pixel by which its centres are
// off the box's lower left corner.
struct PixelShape {
  double width = kInfinity, height = kInfinity;
  Point off;
};

PixelShape pixelShape(const RasterBand& raster, const Box& box, const Crs& crs) {
  constexpr double kStep = 1e-3;  // of the box
  const Point middle{0.5 * (box.xmin + box.xmax), 0.5 * (box.ymin + box.ymax)};
  const double dx = kStep * (box.xmax - box.xmin), dy = kStep * (box.ymax - box.ymin);
  Grid places;
  places.crs = crs;
  for (const Point& place : {middle, middle + Point{dx, 0.0}, middle + Point{0.0, dy}, Point{box.xmin, box.ymin}})
    places.nodes.push_back(place);
  const std::vector<Point> pixels = pixelsOf(places, raster, inOrder);
  const Point east = pixels[1] - pixels[0], north = pixels[2] - pixels[0];
  PixelShape shape{dx / std::hypot(east.x, east.y), dy / std::hypot(north.x, north.y), {0.0, 0.0}};
  if (!std::isfinite(shape.width) || !std::isfinite(shape.height)) return {};
  // If the axes are the raster's own.
  const Point corner = pixels[3] - Point{0.5, 0.5};
  const auto off = [](double pixel, bool grows) { return (grows ? 1.0 : -1.0) * (std::round(pixel) - pixel); };
  if (std::isfinite(corner.x) && std::isfinite(corner.y))
    shape.off = Point{off(corner.x, east.x > 0.0), off(corner.y, north.y > 0.0)};
  return shape;
}

// Metres; the longer side of a cell in the middle of the lattice.
double longestSide(const CellLattice& lattice, const Crs& crs) {
  const Point middle =
      lattice.placeOf(0.5 * static_cast<double>(lattice.columns), 0.5 * static_cast<double>(lattice.rows));
  return std::ranges::max(
      chainLengths({{middle, middle + Point{lattice.width, 0.0}}, {middle, middle + Point{0.0, lattice.height}}}, crs));
}

// Sets the lattice of a box for pixels of this shape. Returns how many pixels a cell is wide and high.
std::size_t layCells(const Box& box, const PixelShape& pixel, CellLattice& lattice) {
  const double across = (box.xmax - box.xmin) / pixel.width, down = (box.ymax - box.ymin) / pixel.height;
  const auto cells = [&](double f) { return (across / f + 2.0 * kAround + 1.0) * (down / f + 2.0 * kAround + 1.0); };
  // From a number that is hardly too small; pixels may be tiny.
  constexpr double kMostPixels = 1e9;  // in a cell, along an axis
  auto factor = static_cast<std::size_t>(std::clamp(std::sqrt(across / kMostCells * down), 1.0, kMostPixels));
  while (cells(static_cast<double>(factor)) > kMostCells && static_cast<double>(factor) < kMostPixels) ++factor;
  const auto f = static_cast<double>(factor);
  lattice.width = f * pixel.width;
  lattice.height = f * pixel.height;
  lattice.west = box.xmin + pixel.off.x * pixel.width - kAround * lattice.width;
  lattice.south = box.ymin + pixel.off.y * pixel.height - kAround * lattice.height;
  lattice.columns = static_cast<std::size_t>(std::ceil(across / f + 2.0 * kAround)) + 1;
  lattice.rows = static_cast<std::size_t>(std::ceil(down / f + 2.0 * kAround)) + 1;
  return factor;
}

// Heights above the still water at places: the value of the first raster with most of the pixels around; NaN if none.
std::vector<double> heightsAt(const Grid& places, const std::vector<RasterBand>& rasters, const DepthOptions& depths,
                              const ItemLoop& loop) {
  constexpr double kMostPixels = 0.5;
  std::vector<double> z(places.nodes.size(), std::numeric_limits<double>::quiet_NaN());
  for (const RasterBand& raster : rasters) {
    std::vector<std::uint32_t> unknown;
    for (std::uint32_t i = 0; i < z.size(); ++i)
      if (std::isnan(z[i])) unknown.push_back(i);
    if (unknown.empty()) break;
    const std::vector<Point> pixels = pixelsOf(places, raster, loop);
    const std::vector<RasterSample> samples = sampleBilinear(raster, pixels, unknown, nullptr, loop, {});
    for (std::size_t k = 0; k < unknown.size(); ++k) {
      if (!(samples[k].share >= kMostPixels)) continue;
      const double value = samples[k].value;
      z[unknown[k]] = (depths.positive_down ? 0.0 - value : value) - depths.water_level_m;
    }
  }
  return z;
}

// The heights of rows [first, last): the mean of `samples` by `samples` places in each cell that have one.
void readRows(const CellLattice& lattice, std::size_t first, std::size_t last, std::size_t samples, const Crs& crs,
              const std::vector<RasterBand>& rasters, const DepthOptions& depths, const ItemLoop& loop,
              std::vector<float>& z) {
  Grid places;
  places.crs = crs;
  const auto shareOf = [samples](std::size_t k) {
    return (static_cast<double>(k) + 0.5) / static_cast<double>(samples) - 0.5;
  };
  for (std::size_t row = first; row < last; ++row)
    for (std::size_t column = 0; column < lattice.columns; ++column)
      for (std::size_t k = 0; k < samples * samples; ++k)
        places.nodes.push_back(lattice.placeOf(static_cast<double>(column) + shareOf(k % samples),
                                               static_cast<double>(row) + shareOf(k / samples)));
  const std::vector<double> heights = heightsAt(places, rasters, depths, loop);
  for (std::size_t cell = lattice.at(0, first), place = 0; cell < lattice.at(0, last); ++cell) {
    double sum = 0.0, known = 0.0;
    for (std::size_t k = 0; k < samples * samples; ++k, ++place) {
      if (std::isnan(heights[place])) continue;
      sum += heights[place];
      ++known;
    }
    const bool is_known = 2.0 * known >= static_cast<double>(samples * samples);
    z[cell] = is_known ? static_cast<float>(sum / known) : std::numeric_limits<float>::quiet_NaN();
  }
}

// Beyond the box, where a raster may end, heights go on like those at its sides, so that contours leave it straight.
void continueBeyond(const Box& box, const CellLattice& lattice, std::vector<float>& z) {
  const auto inside = [](double first, double size, std::size_t count, double low, double high, std::size_t i) {
    const auto least = std::ceil((low - first) / size), most = std::floor((high - first) / size);
    const double last = static_cast<double>(count - 1);
    return static_cast<std::size_t>(
        std::clamp(static_cast<double>(i), std::clamp(least, 0.0, last), std::clamp(std::max(least, most), 0.0, last)));
  };
  for (std::size_t row = 0; row < lattice.rows; ++row)
    for (std::size_t column = 0; column < lattice.columns; ++column) {
      float& here = z[lattice.at(column, row)];
      if (std::isnan(here))
        here = z[lattice.at(inside(lattice.west, lattice.width, lattice.columns, box.xmin, box.xmax, column),
                            inside(lattice.south, lattice.height, lattice.rows, box.ymin, box.ymax, row))];
    }
}

std::string inMetres(double metres) {
  char text[40];
  std::snprintf(text, sizeof text, "%.3g m", metres);
  return text;
}

}  // namespace

HeightCells heightCells(const Coastline& coastline, const FloodOptions& options, const ItemLoop& loop) {
  std::vector<RasterBand> rasters;
  for (const std::string& file : options.heights.files) rasters.emplace_back(file);
  const Box box = searchedBox(coastline, rasters);
  PixelShape finest;
  for (const RasterBand& raster : rasters) {
    const PixelShape shape = pixelShape(raster, box, coastline.crs);
    if (shape.width * shape.height < finest.width * finest.height) finest = shape;
  }
  if (!(finest.width * finest.height < kInfinity))
    throw InputError("--flood-height: no raster of --bathymetry reaches the frame " + inWords(box));
  HeightCells cells;
  const std::size_t factor = layCells(box, finest, cells.lattice);
  const double side_m = longestSide(cells.lattice, coastline.crs);
  if (factor > 1 && side_m > kShareOfElement * options.size_m)
    throw InputError("--flood-height: the frame " + inWords(box) +
                     " has too many pixels: heights could be taken to cells of " + inMetres(side_m) +
                     " only, more than a third of the elements at the shore; give a smaller frame, or "
                     "a larger --size-shore");
  if (factor > 1)
    cells.notes.push_back("--flood-height: the frame has too many pixels: heights were averaged to cells of " +
                          inMetres(side_m) + " to find the low land");
  cells.z.resize(cells.lattice.count());
  const std::size_t samples = std::min(factor, kMostSamples);
  constexpr std::size_t kAtOnce = 1 << 20;  // places
  const std::size_t step = std::max<std::size_t>(1, kAtOnce / (cells.lattice.columns * samples * samples));
  for (std::size_t row = 0; row < cells.lattice.rows; row += step)
    readRows(cells.lattice, row, std::min(row + step, cells.lattice.rows), samples, coastline.crs, rasters,
             options.heights, loop, cells.z);
  if (std::ranges::all_of(cells.z, [](float z) { return std::isnan(z); }))
    throw InputError("--flood-height: no raster of --bathymetry has a value in " + inWords(box) +
                     ": do they lie elsewhere?");
  if (!boundsOfFrames(coastline).empty()) continueBeyond(box, cells.lattice, cells.z);
  return cells;
}

}  // namespace coastmesh
