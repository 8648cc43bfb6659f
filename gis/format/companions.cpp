#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>
#include <vector>

#include "gis/file/output_files.hpp"
#include "gis/format/grid_formats.hpp"
#include "gis/format/grid_io.hpp"
#include "gis/lower_case.hpp"

namespace coastmesh {
namespace {

namespace fs = std::filesystem;

// Files with the same stem and these endings form one source.
const std::vector<std::vector<std::string_view>> kSets = {{".shp", ".shx", ".dbf", ".cpg", ".qix", ".sbn", ".sbx"},
                                                          {".tab", ".dat", ".map", ".id", ".ind"},
                                                          {".mif", ".mid"}};
// Files beside any source: its CRS, georeference, other metadata.
constexpr std::array<std::string_view, 8> kInPlace = {".prj", ".qpj", ".tfw", ".wld", ".hdr", ".gfs", ".xsd", ".clr"};
constexpr std::array<std::string_view, 6> kAfter = {".aux.xml", ".ovr", ".msk", ".qpj", "-wal", "-journal"};

}  // namespace

std::vector<std::string> companionsOf(const std::string& path) {
  std::vector<std::string> all;
  std::error_code error;
  if (fs::is_directory(path, error)) {
    for (fs::directory_iterator entry(path, error), end; !error && entry != end; entry.increment(error))
      all.push_back(entry->path().string());
    return all;
  }
  const std::string own = fs::path(path).extension().string(), lower = lowerCase(own);
  const auto add = [&](std::string_view ending) {
    all.push_back(fs::path(path).replace_extension(ending).string());
    // LAKE.SHP has its LAKE.DBF.
    if (own != lower) all.push_back(fs::path(path).replace_extension(upperCase(ending)).string());
  };
  std::ranges::for_each(kInPlace, add);
  for (const auto& set : kSets) {
    if (std::ranges::count(set, lower) > 0) std::ranges::for_each(set, add);
  }
  for (const std::string_view ending : kAfter) all.push_back(path + std::string(ending));
  // A .poly may have its vertices in a .node.
  const GridFormat* format = lower == ".poly" ? &gridFormatFor(".node") : formatByEnding(path);
  if (format != nullptr) {
    const OutputFiles files = filesOf(*format, path);
    all.insert(all.end(), files.targets.begin(), files.targets.end());
    if (own != lower)
      for (const std::string& target : files.targets)
        all.push_back(fs::path(target).replace_extension(upperCase(fs::path(target).extension().string())).string());
    if (!files.prj.empty()) all.push_back(files.prj);
  }
  std::erase(all, path);
  return all;
}

}  // namespace coastmesh
