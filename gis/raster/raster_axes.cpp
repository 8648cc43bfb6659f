#include "gis/raster/raster_axes.hpp"

#include <gdal_priv.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "gis/error.hpp"

namespace coastmesh {

namespace {

// Pixels: deviation up to which spacing counts as even, since numbers are rounded, to four decimals for instance.
constexpr double kEvenPixels = 0.05;
// Rounding of coordinates in single precision, relative to the largest.
constexpr double kRounding = 1.2e-7;

struct CloseDataset {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};

bool isOneOf(std::string_view unit, std::initializer_list<std::string_view> names) {
  return std::ranges::find(names, unit) != names.end();
}

// The variable of the band, which GDAL names by group and name in `NETCDF:"file":/group/name`.
std::shared_ptr<GDALMDArray> arrayOf(GDALDataset& dataset, const GDALGroup& root) {
  const std::string_view opened = dataset.GetDescription();
  const std::size_t colon = opened.rfind(':');
  if (opened.starts_with("NETCDF:") && colon + 1 < opened.size() && opened[colon + 1] == '/')
    return root.OpenMDArrayFromFullname(std::string(opened.substr(colon + 1)));
  const char* const name = dataset.GetRasterBand(1)->GetMetadataItem("NETCDF_VARNAME");
  return name == nullptr ? nullptr : root.OpenMDArray(name);
}

std::optional<RasterAxis> axisAlong(const GDALDimension& dimension, int pixels) {
  const std::shared_ptr<GDALMDArray> variable = dimension.GetIndexingVariable();
  if (!variable || variable->GetDimensionCount() != 1 || variable->GetDataType().GetClass() != GEDTC_NUMERIC ||
      variable->GetDimensions().front()->GetSize() != static_cast<GUInt64>(pixels))
    return std::nullopt;
  RasterAxis axis{variable->GetName(), variable->GetUnit(), "", {}};
  if (const auto standard = variable->GetAttribute("standard_name")) {
    const char* const text = standard->ReadAsString();
    axis.standard_name = text == nullptr ? "" : text;
  }
  axis.places.resize(static_cast<std::size_t>(pixels));
  const GUInt64 first = 0;
  const std::size_t count = axis.places.size();
  if (!variable->Read(&first, &count, nullptr, nullptr, GDALExtendedDataType::Create(GDT_Float64), axis.places.data()))
    return std::nullopt;
  return axis;
}

}  // namespace

bool RasterAxis::isLongitude() const {
  return standard_name == "longitude" ||
         isOneOf(unit, {"degrees_east", "degree_east", "degree_E", "degrees_E", "degreeE", "degreesE"});
}

bool RasterAxis::isLatitude() const {
  return standard_name == "latitude" ||
         isOneOf(unit, {"degrees_north", "degree_north", "degree_N", "degrees_N", "degreeN", "degreesN"});
}

std::optional<RasterAxes> axesOf(GDALDataset& dataset) {
  GDALDriver* const driver = dataset.GetDriver();
  if (driver == nullptr || std::string_view(driver->GetDescription()) != "netCDF") return std::nullopt;
  char** const files = dataset.GetFileList();
  const std::string file = files == nullptr || files[0] == nullptr ? "" : files[0];
  CSLDestroy(files);
  if (file.empty()) return std::nullopt;
  const char* const drivers[] = {"netCDF", nullptr};
  const std::unique_ptr<GDALDataset, CloseDataset> arrays(
      GDALDataset::Open(file.c_str(), GDAL_OF_MULTIDIM_RASTER, drivers));
  const std::shared_ptr<GDALGroup> root = arrays ? arrays->GetRootGroup() : nullptr;
  const std::shared_ptr<GDALMDArray> array = root ? arrayOf(dataset, *root) : nullptr;
  if (!array || array->GetDimensionCount() < 2) return std::nullopt;
  const auto& dimensions = array->GetDimensions();
  auto columns = axisAlong(*dimensions[dimensions.size() - 1], dataset.GetRasterXSize());
  auto rows = axisAlong(*dimensions[dimensions.size() - 2], dataset.GetRasterYSize());
  if (!columns || !rows) return std::nullopt;
  return RasterAxes{std::move(*columns), std::move(*rows)};
}

std::shared_ptr<const UnevenAxis> UnevenAxis::from(const RasterAxis& axis, double step, const std::string& file) {
  std::vector<double> centres = axis.places;
  const std::size_t count = centres.size();
  if (count < 3) return nullptr;
  // Unwraps longitudes that jump at the antimeridian.
  if (axis.isLongitude())
    for (std::size_t i = 1; i < count; ++i)
      if (std::abs(centres[i] - centres[i - 1]) > 180.0)
        centres[i] += 360.0 * std::round((centres[i - 1] - centres[i]) / 360.0);
  if ((centres.back() - centres.front()) * step < 0.0) std::ranges::reverse(centres);
  const double first = centres.front(), spacing = (centres.back() - first) / static_cast<double>(count - 1);
  const double rounding = kRounding * std::max(std::abs(first), std::abs(centres.back())) / std::abs(spacing);
  bool is_even = true, rises = true;  // both become false at a NaN
  for (std::size_t i = 0; i < count; ++i) {
    centres[i] = 0.5 + (centres[i] - first) / spacing;
    const double off = std::abs(centres[i] - 0.5 - static_cast<double>(i));
    is_even = is_even && off <= std::max(kEvenPixels, rounding);
    rises = rises && std::isfinite(centres[i]) && (i == 0 || centres[i] > centres[i - 1]);
  }
  if (is_even) return nullptr;
  if (!rises)
    throw InputError("'" + file + "': the numbers of its axis '" + axis.name +
                     "' neither rise nor fall all along, so that they do not say where its pixels lie");
  return std::shared_ptr<const UnevenAxis>(new UnevenAxis(std::move(centres)));
}

double UnevenAxis::pixelOf(double even) const {
  // Extrapolates by the outermost spacing. NaN stays NaN.
  const auto next = std::clamp<std::ptrdiff_t>(std::ranges::upper_bound(centres_, even) - centres_.begin(), 1,
                                               static_cast<std::ptrdiff_t>(centres_.size()) - 1);
  const auto after = static_cast<std::size_t>(next);
  const double from = centres_[after - 1], to = centres_[after];
  return static_cast<double>(after) - 0.5 + (even - from) / (to - from);
}

double UnevenAxis::evenOf(double pixel) const {
  if (!std::isfinite(pixel)) return pixel;
  const double last = static_cast<double>(centres_.size() - 1);
  const auto after = static_cast<std::size_t>(std::clamp(std::floor(pixel - 0.5) + 1.0, 1.0, last));
  const double from = centres_[after - 1], to = centres_[after];
  return from + (pixel - 0.5 - static_cast<double>(after - 1)) * (to - from);
}

std::vector<int> UnevenAxis::cuts(int longest) const {
  constexpr int kBlock = 16;  // pixels: unevenness within a block averages out
  constexpr double kAlike = 1.1;
  const auto end = static_cast<int>(centres_.size());
  std::vector<int> cuts{0};
  double spacing_there = 0.0;
  for (int at = 0; at < end; at += kBlock) {
    const int next = std::min(at + kBlock, end - 1);
    const double spacing = (evenOf(next) - evenOf(at)) / std::max(1, next - at);
    const bool is_alike = spacing <= kAlike * spacing_there && spacing_there <= kAlike * spacing;
    if (at > 0 && at % longest != 0 && is_alike) continue;
    if (at > 0) cuts.push_back(at);
    spacing_there = spacing;
  }
  cuts.push_back(end);
  return cuts;
}

}  // namespace coastmesh
