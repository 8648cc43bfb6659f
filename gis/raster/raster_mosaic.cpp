#include "gis/raster/raster_mosaic.hpp"

#include <cpl_conv.h>
#include <cpl_minixml.h>
#include <gdal_priv.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string_view>

namespace coastmesh {

namespace {

// With more cells per file, files overlap or are scattered: the raster is not a mosaic of tiles.
constexpr std::size_t kMostCellsPerFile = 16;

struct FreeXml {
  void operator()(CPLXMLNode* node) const { CPLDestroyXMLNode(node); }
};
using Xml = std::unique_ptr<CPLXMLNode, FreeXml>;

struct Placed {
  std::string file;
  PixelRect at;
};

std::optional<int> whole(const CPLXMLNode* node, const char* attribute) {
  constexpr double kRounding = 1e-3, kMost = 1e9;  // pixels
  const char* const text = CPLGetXMLValue(node, attribute, nullptr);
  if (text == nullptr) return std::nullopt;
  const double value = CPLAtof(text), rounded = std::round(value);
  if (!(std::abs(value - rounded) <= kRounding) || !(std::abs(rounded) <= kMost)) return std::nullopt;
  return static_cast<int>(rounded);
}

// Nullopt if the source is of another kind, scaled, or not aligned with pixels.
std::optional<Placed> placedBy(const CPLXMLNode* source) {
  const std::string_view kind = source->pszValue;
  const char* const file = CPLGetXMLValue(source, "SourceFilename", nullptr);
  const CPLXMLNode* const from = CPLGetXMLNode(source, "SrcRect");
  const CPLXMLNode* const to = CPLGetXMLNode(source, "DstRect");
  if ((kind != "SimpleSource" && kind != "ComplexSource") || file == nullptr || from == nullptr || to == nullptr)
    return std::nullopt;
  std::optional<int> of[8];
  for (int k = 0; k < 8; ++k) {
    static constexpr const char* kNames[] = {"xOff", "yOff", "xSize", "ySize"};
    of[k] = whole(k < 4 ? from : to, kNames[k % 4]);
    if (!of[k]) return std::nullopt;
  }
  if (of[2] != of[6] || of[3] != of[7]) return std::nullopt;
  return Placed{file, {*of[4], *of[5], *of[6], *of[7]}};
}

bool isSource(const CPLXMLNode* node) {
  return node->eType == CXT_Element && std::string_view(node->pszValue).ends_with("Source");
}

std::vector<int> cutsAlong(const std::vector<Placed>& placed, int end, int PixelRect::*from, int PixelRect::*length) {
  std::vector<int> cuts{0, end};
  for (const Placed& each : placed)
    for (const int at : {each.at.*from, each.at.*from + each.at.*length})
      if (at > 0 && at < end) cuts.push_back(at);
  std::ranges::sort(cuts);
  cuts.erase(std::unique(cuts.begin(), cuts.end()), cuts.end());
  return cuts;
}

// By extension only: there may be thousands of tiles, and they may be remote.
bool isNamedAsNetcdf(const char* file) {
  return std::ranges::any_of(std::initializer_list<const char*>{"nc", "nc4", "cdf", "grd"},
                             [file](const char* extension) { return EQUAL(CPLGetExtension(file), extension); });
}

void addNetcdfParts(const CPLXMLNode* node, std::vector<std::string>& parts) {
  for (; node != nullptr; node = node->psNext) {
    const char* const file = isSource(node) ? CPLGetXMLValue(node, "SourceFilename", "") : "";
    if (std::string_view(file).starts_with("NETCDF:")) parts.emplace_back(file);
    addNetcdfParts(node->psChild, parts);
  }
}

}  // namespace

bool isVirtual(GDALDataset& dataset) {
  GDALDriver* const driver = dataset.GetDriver();
  return driver != nullptr && std::string_view(driver->GetDescription()) == "VRT";
}

std::vector<std::string> netcdfFilesOf(GDALDataset& dataset) {
  std::vector<std::string> files;
  if (!isVirtual(dataset)) return files;
  char** const list = dataset.GetFileList();
  for (int i = 0; list != nullptr && list[i] != nullptr; ++i)
    if (isNamedAsNetcdf(list[i])) files.emplace_back(list[i]);
  CSLDestroy(list);
  char** const text = dataset.GetMetadata("xml:VRT");
  const Xml xml(text == nullptr || text[0] == nullptr ? nullptr : CPLParseXMLString(text[0]));
  addNetcdfParts(xml.get(), files);
  return files;
}

std::shared_ptr<const RasterMosaic> mosaicOf(GDALDataset& dataset, int columns) {
  if (!isVirtual(dataset)) return nullptr;
  char** const text = dataset.GetMetadata("xml:VRT");
  if (text == nullptr || text[0] == nullptr) return nullptr;
  const Xml xml(CPLParseXMLString(text[0]));
  const CPLXMLNode* const root = CPLGetXMLNode(xml.get(), "=VRTDataset");
  // A VRT that warps has no sources; one with a mask has more than one band per file.
  if (root == nullptr || CPLGetXMLNode(root, "MaskBand") != nullptr) return nullptr;
  const CPLXMLNode* const band = CPLGetXMLNode(root, "VRTRasterBand");
  if (band == nullptr || CPLGetXMLNode(band, "MaskBand") != nullptr) return nullptr;
  std::vector<Placed> placed;
  for (const CPLXMLNode* node = band->psChild; node != nullptr; node = node->psNext) {
    if (!isSource(node)) continue;
    std::optional<Placed> source = placedBy(node);
    if (!source) return nullptr;
    placed.push_back(std::move(*source));
  }
  const PixelRect all{0, 0, columns, dataset.GetRasterYSize()};
  for (Placed& each : placed) each.at = each.at.in(all);
  std::erase_if(placed, [](const Placed& each) { return each.at.isEmpty(); });
  auto mosaic = std::make_shared<RasterMosaic>();
  mosaic->cuts = {cutsAlong(placed, all.width, &PixelRect::x, &PixelRect::width),
                  cutsAlong(placed, all.height, &PixelRect::y, &PixelRect::height)};
  if (placed.size() < 2 || mosaic->cuts.cells() > kMostCellsPerFile * placed.size()) return nullptr;
  mosaic->file_of.assign(mosaic->cuts.cells(), -1);
  bool overlap = false;
  for (Placed& each : placed) {
    const auto file = static_cast<int>(mosaic->files.size());
    mosaic->cuts.forEachCell(each.at, [&](std::size_t cell) {
      overlap |= mosaic->file_of[cell] >= 0;
      mosaic->file_of[cell] = file;
    });
    mosaic->files.push_back(std::move(each.file));
  }
  return overlap ? nullptr : mosaic;
}

}  // namespace coastmesh
