#include "gis/read/line_files.hpp"

#include <ogrsf_frmts.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <new>
#include <optional>
#include <string_view>
#include <utility>

#include "gis/crs/crs.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"
#include "gis/file/prj_file.hpp"
#include "gis/file/text_reader.hpp"
#include "gis/finite_number.hpp"
#include "gis/lower_case.hpp"

namespace coastmesh {

namespace {

std::string endingOf(const std::string& path) { return lowerCase(std::filesystem::path(path).extension().string()); }

// A layer in memory to which lines are added point by point.
class LineLayer {
 public:
  // `crs`: unless a .prj beside the file says another.
  LineLayer(const std::string& path, const char* attribute, OGRFieldType type, const Crs& crs = {}) {
    registerDrivers();
    GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("Memory");
    if (driver == nullptr) driver = GetGDALDriverManager()->GetDriverByName("MEM");
    dataset_.reset(driver == nullptr ? nullptr : driver->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    const std::string name = std::filesystem::path(path).stem();
    const Crs said = readPrjBeside(path, crs);
    std::optional<OGRSpatialReference> srs = said.isPlane() ? std::nullopt : std::optional(toOgr(said));
    layer_ = dataset_ ? dataset_->CreateLayer(name.c_str(), srs ? &*srs : nullptr, wkbUnknown, nullptr) : nullptr;
    OGRFieldDefn field(attribute, type);
    if (layer_ == nullptr || layer_->CreateField(&field) != OGRERR_NONE)
      throw InputError("'" + path + "' cannot be read: GDAL has no layers in memory");
  }

  void addPoint(double x, double y, std::optional<double> z) {
    if (z) {
      line_.addPoint(x, y, *z);
    } else {
      line_.addPoint(x, y);
    }
  }
  template <typename Value>
  void endLine(const Value& value, bool as_ring = false) {
    if (line_.IsEmpty()) return;
    OGRPoint first;
    line_.getPoint(0, &first);
    if (as_ring && line_.getNumPoints() > 2 && !line_.get_IsClosed()) line_.addPoint(&first);
    OGRFeature feature(layer_->GetLayerDefn());
    feature.SetField(0, value);
    feature.SetGeometry(line_.getNumPoints() == 1 ? static_cast<OGRGeometry*>(&first) : &line_);
    if (layer_->CreateFeature(&feature) != OGRERR_NONE) throw std::bad_alloc();
    line_ = OGRLineString();
  }
  std::unique_ptr<GDALDataset> release() && { return std::move(dataset_); }

 private:
  std::unique_ptr<GDALDataset> dataset_;
  OGRLayer* layer_ = nullptr;
  OGRLineString line_;
};

// A count of points in the file, of which each takes a line.
std::uint64_t pointCount(TextReader& file) {
  const std::uint64_t count = file.count();
  if (count > file.size()) file.fail(std::to_string(count) + " points, which is more than the file can hold");
  return count;
}

// The next word of the line, if it is a number; labels may follow the coordinates.
std::optional<double> numberIfAny(TextReader& file) { return finiteNumber(file.word()); }

// Blocks of a name, the numbers of rows and columns, and the rows; lines that begin with * are comments.
std::unique_ptr<GDALDataset> readBlocks(const std::string& path) {
  TextReader file(path);
  LineLayer lines(path, "name", OFTString);
  const bool rings = endingOf(path) == ".pol";
  const auto nextLine = [&file] {
    while (file.nextLine())
      if (!trimmed(file.line()).starts_with('*')) return true;
    return false;
  };
  const auto isMissing = [](double x, double y) {
    constexpr std::array kMissing = {999.999, -999.0, -999.999};
    return x == y && std::ranges::find(kMissing, x) != kMissing.end();
  };
  while (nextLine()) {
    const std::string name(trimmed(file.line()));
    if (!nextLine()) file.fail("the block '" + name + "' has no counts of rows and columns");
    const std::uint64_t rows = pointCount(file);
    const std::uint64_t columns = file.hasWord() ? file.count() : 2;
    if (columns < 2) file.fail("the block '" + name + "' has " + std::to_string(columns) + " column, not x and y");
    for (std::uint64_t row = 0; row < rows; ++row) {
      if (!nextLine())
        file.fail("the block '" + name + "' ends after " + std::to_string(row) + " of " + std::to_string(rows) +
                  " points");
      const double x = file.number(), y = file.number();
      if (isMissing(x, y)) {
        lines.endLine(name.c_str(), rings);
      } else {
        lines.addPoint(x, y, columns > 2 ? numberIfAny(file) : std::nullopt);
      }
    }
    lines.endLine(name.c_str(), rings);
  }
  return std::move(lines).release();
}

// A header of keywords that begin with a colon, up to :EndHeader; then for each line the number of its points and a
// value, and the points.
std::unique_ptr<GDALDataset> readLineSet(const std::string& path) {
  TextReader file(path, '\0', " \t\r");
  bool geographic = false;
  for (bool ended = false; !ended;) {
    if (!file.nextLine()) file.fail("the header has no :EndHeader");
    const std::string keyword = lowerCase(std::string(file.word()));
    if (keyword == ":filetype") {
      file.word();  // i2s or i3s, as the ending
      if (lowerCase(std::string(file.word())) == "binary")
        file.fail("a binary line set; save it from Blue Kenue as text (ASCII)");
    }
    if (keyword == ":projection") geographic = lowerCase(std::string(file.word())) == "latlong";
    ended = keyword == ":endheader";
  }
  LineLayer lines(path, "value", OFTReal, geographic ? wgs84() : Crs{});
  const bool has_z = endingOf(path) == ".i3s";
  while (file.nextLine()) {
    if (file.line().starts_with('#')) continue;
    const std::uint64_t points = pointCount(file);
    const double value = numberIfAny(file).value_or(0.0);
    for (std::uint64_t point = 0; point < points; ++point) {
      file.needLine();
      const double x = file.number(), y = file.number();
      lines.addPoint(x, y, has_z ? std::optional(file.number()) : std::nullopt);
    }
    lines.endLine(value);
  }
  return std::move(lines).release();
}

// For each line the number of its points, a flag, and perhaps a name in quotes; then the points.
std::unique_ptr<GDALDataset> readBlankingFile(const std::string& path) {
  TextReader file(path);
  LineLayer lines(path, "name", OFTString);
  while (file.nextLine()) {
    const std::uint64_t points = pointCount(file);
    std::string name;
    if (file.hasWord()) file.integer();  // on which side Surfer blanks a grid
    if (const std::size_t quote = file.line().find('"'); quote != std::string_view::npos) {
      const std::string_view quoted = file.line().substr(quote + 1);
      name = quoted.substr(0, quoted.find('"'));
    }
    for (std::uint64_t point = 0; point < points; ++point) {
      file.needLine();
      const double x = file.number(), y = file.number();
      lines.addPoint(x, y, numberIfAny(file));
    }
    lines.endLine(name.c_str());
  }
  return std::move(lines).release();
}

using Reader = std::unique_ptr<GDALDataset> (*)(const std::string&);
constexpr std::array<std::pair<std::string_view, Reader>, 7> kReaders = {{{".ldb", readBlocks},
                                                                          {".pli", readBlocks},
                                                                          {".pliz", readBlocks},
                                                                          {".pol", readBlocks},
                                                                          {".i2s", readLineSet},
                                                                          {".i3s", readLineSet},
                                                                          {".bln", readBlankingFile}}};

Reader readerFor(const std::string& path) {
  const std::string ending = endingOf(path);
  const auto found = std::ranges::find(kReaders, ending, [](const auto& entry) { return entry.first; });
  return found == kReaders.end() ? nullptr : found->second;
}

}  // namespace

bool isLineFile(const std::string& path) { return readerFor(path) != nullptr; }

std::unique_ptr<GDALDataset> readLineFile(const std::string& path) { return readerFor(path)(path); }

}  // namespace coastmesh
