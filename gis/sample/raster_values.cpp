#include "gis/sample/raster_values.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "gis/sample/sample_average.hpp"
#include "gis/sample/sample_nearest.hpp"

namespace coastmesh {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
// If the triangles around a node have fewer pixels than this, those at the node are used.
constexpr double kLeastPixels = 4.0;
// The share of pixels in a node's triangles that must have a value for their mean to take precedence over other
// rasters.
constexpr double kMostPixels = 0.5;

}  // namespace

RasterValues::RasterValues(const Grid& grid, const RasterSampling& how, const ItemLoop& loop)
    : grid_(grid),
      how_(how),
      loop_(loop),
      values_(grid.nodes.size(), kUnknown),
      partial_(grid.nodes.size(), kUnknown),
      partial_file_(grid.nodes.size(), 0) {}

void RasterValues::take(const RasterSource& source, const RunControl& control) {
  counts_.nodes_of_file.push_back(0);
  const RasterBand raster(source.path, how_.kind);
  raster.requireEvenFiles();
  const std::vector<std::string>& notes = raster.geometry().notes;
  counts_.notes.insert(counts_.notes.end(), notes.begin(), notes.end());
  if (raster.crs().isPlane() && !grid_.crs.isPlane())
    counts_.warnings.push_back("'" + raster.path() + "' has no CRS; taken to be in that of the mesh, " +
                               nameOf(grid_.crs));
  std::vector<std::uint32_t> open = unknownNodes();
  if (open.empty()) return;
  const std::vector<Point> pixels = pixelsOf(grid_, raster, loop_);
  if (!how_.nearest && (how_.average || source.classes != nullptr)) {
    const auto samples = sampleAverage(raster, grid_, pixels, open, kLeastPixels, loop_, control, source.classes);
    counts_.averaged += put(open, samples, kMostPixels);
    open = unknownNodes();
  }
  put(open,
      how_.nearest || source.classes != nullptr ? sampleNearest(raster, pixels, open, source.classes, loop_, control)
                                                : sampleBilinear(raster, pixels, open, how_.readers, loop_, control),
      1.0);
}

std::vector<double> RasterValues::finish() {
  for (std::size_t i = 0; i < values_.size(); ++i) {
    if (!std::isnan(values_[i]) || std::isnan(partial_[i])) continue;
    values_[i] = partial_[i];
    ++counts_.partial;
    ++counts_.nodes_of_file[partial_file_[i]];
  }
  return std::move(values_);
}

std::vector<std::uint32_t> RasterValues::unknownNodes() const {
  std::vector<std::uint32_t> nodes;
  for (std::uint32_t i = 0; i < values_.size(); ++i)
    if (std::isnan(values_[i])) nodes.push_back(i);
  return nodes;
}

std::size_t RasterValues::put(const std::vector<std::uint32_t>& nodes, const std::vector<RasterSample>& samples,
                              double least_share) {
  const std::size_t file = counts_.nodes_of_file.size() - 1;
  std::size_t taken = 0;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (!(samples[k].share > 0.0)) continue;
    if (samples[k].share >= least_share) {
      values_[nodes[k]] = samples[k].value;
      ++taken;
    } else if (std::isnan(partial_[nodes[k]])) {
      partial_[nodes[k]] = samples[k].value;
      partial_file_[nodes[k]] = file;
    }
  }
  counts_.nodes_of_file[file] += taken;
  return taken;
}

}  // namespace coastmesh
