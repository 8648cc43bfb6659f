#include "gis/read/open_source.hpp"

#include <cpl_string.h>
#include <cpl_vsi.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string_view>

#include "gis/coast/feature_names.hpp"
#include "gis/error.hpp"
#include "gis/lower_case.hpp"
#include "gis/places.hpp"
#include "gis/read/line_files.hpp"
#include "gis/read/odd_geojson.hpp"
#include "gis/read/osm_ways.hpp"
#include "gis/secrets.hpp"

namespace coastmesh {

namespace {

constexpr std::size_t kMostListed = 8;  // names of layers or columns in an error

bool exists(const std::string& path) {
  VSIStatBufL stat;
  return VSIStatL(path.c_str(), &stat) == 0;
}

bool endsWith(const std::string& text, std::string_view ending) { return lowerCase(text).ends_with(ending); }

std::string stemOf(const std::string& entry) { return std::filesystem::path(entry).stem(); }

bool isStandardInput(const std::string& path) {
  return path == "-" || path == "/dev/stdin" || path == "/vsistdin" || path == "/vsistdin/";
}

std::string nameOf(const std::string& path) { return isStandardInput(path) ? "standard input" : path; }

// For a path without a layer.
bool isStreamFile(const std::string& path) {
  std::error_code error;
  return isStandardInput(path) || std::filesystem::is_fifo(path, error);
}

// A folder of an archive as OGR opens it: the root needs the archive's path in braces.
std::string folderInside(const std::string& archive, const std::string& folder) {
  if (!folder.empty()) return archive + "/" + folder;
  const std::size_t path = archive.find('/', 1) + 1;
  return archive.substr(0, path) + "{" + archive.substr(path) + "}";
}

// Of several files in an archive that is given as `given`: the one named like the wanted layer, or the folder that has
// all wanted layers as shapefiles. `archive` begins with "/vsizip/" or a similar prefix. Throws InputError if there is
// neither.
std::string chosenInside(const std::string& archive, const std::string& given, const std::vector<std::string>& found,
                         const std::vector<std::string>& wanted) {
  namespace fs = std::filesystem;
  std::vector<std::string> stems, chosen;
  std::set<std::string> folders;
  for (const std::string& entry : found) {
    stems.push_back(stemOf(entry));
    if (std::ranges::find(wanted, stems.back()) == wanted.end()) continue;
    chosen.push_back(entry);
    folders.insert(endsWith(entry, ".shp") ? fs::path(entry).parent_path().string() : "no shapefile");
  }
  if (chosen.size() == 1 && wanted.size() == 1) return archive + "/" + chosen.front();
  const std::set<std::string> different(stems.begin(), stems.end());
  const bool by_name = different.size() == stems.size();
  if (by_name && chosen.size() == wanted.size() && chosen.size() > 1 && folders.size() == 1 &&
      *folders.begin() != "no shapefile")
    return folderInside(archive, *folders.begin());
  const std::string shown = nameOf(given);
  for (const std::string& name : wanted)
    if (!different.contains(name))
      throw InputError(sourceInWords(shown) + ": has no layer '" + name + "'; there are " +
                       listed(by_name ? stems : found, kMostListed));
  // Options take a single "-", but no layer after it. A stream is no folder.
  const std::string file = isStandardInput(given) ? "/dev/stdin" : given;
  const std::string one =
      by_name ? file + "|" + stems.front() : (isStreamFile(given) ? "FILE" : file) + "/" + found.front();
  throw InputError(sourceInWords(shown) + ": holds " + std::to_string(found.size()) +
                   (by_name ? " layers (" : " vector files (") + listed(by_name ? stems : found, kMostListed) +
                   "): " + (isStreamFile(given) && !by_name ? "save it to a file, and " : "") + "name one as '" + one +
                   "'" + (by_name && wanted.empty() ? ", or choose one of the input's with --layer" : ""));
}

// The vector file in an archive, at any depth. If there are several, the file or folder with the wanted layers; if none
// has a known ending, the archive itself, which OGR opens as a folder.
std::string insideOf(const std::string& archive, const std::string& given, const std::vector<std::string>& wanted) {
  constexpr std::array<std::string_view, 8> kEndings = {".shp", ".gpkg", ".geojson", ".json",
                                                        ".fgb", ".gml",  ".kml",     ".osm"};
  const CPLStringList entries(VSIReadDirRecursive(archive.c_str()));
  std::vector<std::string> found;
  for (int i = 0; i < entries.size(); ++i) {
    const std::string entry = entries[i], name = std::filesystem::path(entry).filename();
    // Metadata that macOS adds for every file.
    if (name.starts_with("._") || entry.starts_with("__MACOSX/")) continue;
    if (std::ranges::any_of(kEndings, [&](std::string_view ending) { return endsWith(entry, ending); })) {
      found.push_back(entry);
    }
  }
  // A .json beside a file of another kind is metadata.
  const auto isJson = [](const std::string& entry) { return endsWith(entry, ".json"); };
  if (!std::ranges::all_of(found, isJson)) std::erase_if(found, isJson);
  if (found.size() > 1) return chosenInside(archive, given, found, wanted);
  return found.empty() ? archive : archive + "/" + found.front();
}

// The ending of the kind of archive that a file holds; empty for any other file.
std::string archiveEnding(const std::string& path) {
  const auto beginOf = [](const std::string& file) {
    constexpr std::size_t kBytes = 512;  // a header in a .tar
    std::string bytes(kBytes, '\0');
    const std::unique_ptr<VSILFILE, int (*)(VSILFILE*)> opened(VSIFOpenL(file.c_str(), "rb"), VSIFCloseL);
    bytes.resize(opened ? VSIFReadL(bytes.data(), 1, kBytes, opened.get()) : 0);
    return bytes;
  };
  const auto isTar = [](const std::string& bytes) {
    constexpr std::size_t kMagic = 257;
    return bytes.size() > kMagic && bytes.compare(kMagic, 5, "ustar") == 0;
  };
  const std::string bytes = beginOf(path);
  if (bytes.starts_with("PK\x03\x04")) return ".zip";
  if (bytes.starts_with("\x1f\x8b")) return isTar(beginOf("/vsigzip/" + path)) ? ".tgz" : ".gz";
  return isTar(bytes) ? ".tar" : "";
}

// Copies a stream to a file in memory and returns its path: a pipe can be read only once, but drivers read repeatedly.
std::string inMemory(const std::string& given) {
  const std::string name = nameOf(given);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> opened(
      isStandardInput(given) ? nullptr : std::fopen(given.c_str(), "rb"),
      [](std::FILE* file) { return std::fclose(file); });
  std::FILE* const stream = isStandardInput(given) ? stdin : opened.get();
  if (stream == nullptr) throw InputError(sourceInWords(name) + ": cannot be opened: " + std::strerror(errno));
  constexpr std::size_t kPiece = std::size_t{1} << 20;
  std::vector<GByte> bytes;
  for (std::size_t got = kPiece; got == kPiece;) {
    const std::size_t before = bytes.size();
    bytes.resize(before + kPiece);
    got = std::fread(bytes.data() + before, 1, kPiece, stream);
    const int reason = errno;
    if (std::ferror(stream) != 0) throw InputError(sourceInWords(name) + ": cannot be read: " + std::strerror(reason));
    bytes.resize(before + got);
  }
  if (bytes.empty()) throw InputError(sourceInWords(name) + ": it is empty");
  const std::string_view head(reinterpret_cast<const char*>(bytes.data()), std::min<std::size_t>(bytes.size(), 64));
  std::string path = "/vsimem/coastmesh_standard_input";
  if (opened) {
    path = "/vsimem/coastmesh_stream" + given;
    std::replace(path.begin() + 8, path.end(), '/', '_');
  }
  if (head.starts_with("SQLite format 3")) path += ".gpkg";
  VSILFILE* file = VSIFOpenL(path.c_str(), "wb");
  const bool written = file != nullptr && VSIFWriteL(bytes.data(), 1, bytes.size(), file) == bytes.size();
  if (file != nullptr) VSIFCloseL(file);
  if (!written) throw InputError(sourceInWords(name) + ": too large to be held in memory");
  // Archives are opened by their endings.
  const std::string plain = path;
  path += archiveEnding(plain);
  if (path != plain) VSIRename(plain.c_str(), path.c_str());
  return path;
}

// The path for OGR; in an archive of several files, that of the wanted layers, if any.
std::string pathForOgr(const std::string& path, const std::vector<std::string>& wanted) {
  const std::string real = isStreamFile(path) ? inMemory(path) : path;
  if (real.starts_with("/vsi") && !real.starts_with("/vsimem/")) return real;
  if (endsWith(real, ".shp.zip")) return real;
  if (!exists(real)) {  // a file in an archive
    for (const auto& [ending, prefix] :
         {std::pair{".zip/", "/vsizip/"}, {".tar/", "/vsitar/"}, {".tgz/", "/vsitar/"}}) {
      if (lowerCase(real).find(ending) != std::string::npos && exists(prefix + real)) return prefix + real;
    }
    return real;
  }
  registerDrivers();
  if (endsWith(real, ".kmz") && GDALGetDriverByName("LIBKML") != nullptr) return real;
  if (endsWith(real, ".zip") || endsWith(real, ".kmz")) return insideOf("/vsizip/" + real, path, wanted);
  if (endsWith(real, ".tar") || endsWith(real, ".tgz") || endsWith(real, ".tar.gz"))
    return insideOf("/vsitar/" + real, path, wanted);
  if (endsWith(real, ".gz")) return "/vsigzip/" + real;
  return real;
}

// "; its fields are …": of all layers.
std::string fieldsInWords(const OpenSource& source) {
  std::vector<std::string> names;
  for (OGRLayer* layer : source.layers) {
    const OGRFeatureDefn& table = *layer->GetLayerDefn();
    for (int i = 0; i < table.GetFieldCount(); ++i) {
      std::string name = oneLine(table.GetFieldDefn(i)->GetNameRef());
      if (std::ranges::find(names, name) == names.end()) names.push_back(std::move(name));
    }
  }
  constexpr std::size_t kShown = 30;
  return names.empty() ? "; it has no fields" : "; its fields are " + listed(names, kShown);
}

// True for the name of something other than a file: of a database ("PG:dbname=coasts"), or a URL.
bool isConnection(const std::string& path) {
  if (path.find("://") != std::string::npos) return true;
  for (int i = 0; i < GDALGetDriverCount(); ++i) {
    const char* const prefix = GDALGetMetadataItem(GDALGetDriver(i), GDAL_DMD_CONNECTION_PREFIX, nullptr);
    if (prefix != nullptr && *prefix != '\0' && STARTS_WITH_CI(path.c_str(), prefix)) return true;
  }
  return false;
}

[[noreturn]] void refuse(const std::string& name, const std::string& path, const OgrErrors& errors) {
  std::string why;
  if (!errors.text().empty()) why.append(" (").append(errors.text()).append(")");
  if (name.find("/vsistdin") != std::string::npos)
    throw InputError(sourceInWords(name) + ": cannot be opened" + why +
                     ": name standard input '-', which may hold an archive");
  VSIStatBufL stat;
  if (VSIStatL(path.c_str(), &stat) != 0) {
    if (isConnection(path)) throw InputError(sourceInWords(name) + ": cannot be opened" + why);
    // Of a missing file GDAL says no more than that.
    const bool says_more = path.starts_with("/vsi") || errors.text().find("No such file") == std::string::npos;
    throw InputError(sourceInWords(name) + ": no such file; check the path, or name a source that OGR can open" +
                     (says_more ? why : ""));
  }
  if (!VSI_ISDIR(stat.st_mode) && stat.st_size == 0) throw InputError(sourceInWords(name) + ": the file is empty");
  // GDAL does not open a file that is one odd geometry, and does not report where it is odd.
  if (const std::optional<std::string> odd = why.empty() ? std::nullopt : oddGeojson(path))
    throw InputError(sourceInWords(name) + ", " + *odd + ": repair or remove this feature");
  throw NotVectorError(name, sourceInWords(name) + ": not a vector file that GDAL can read" + why);
}

// Splits "file|layer" into file and layer, unless a file has the whole name.
std::pair<std::string, std::string> splitLayer(const std::string& path) {
  const std::size_t bar = path.rfind('|');
  if (bar == std::string::npos || exists(path)) return {path, {}};
  std::string layer = path.substr(bar + 1);
  constexpr std::string_view kQgis = "layername=";
  if (layer.starts_with(kQgis)) layer.erase(0, kQgis.size());
  return {path.substr(0, bar), layer};
}

// True for a text table in which GDAL finds no column of geometries.
bool hasTextsOnly(GDALDataset& dataset) {
  if (dataset.GetDriverName() != std::string_view("CSV")) return false;
  for (OGRLayer* layer : dataset.GetLayers())
    if (layer->GetLayerDefn()->GetGeomFieldCount() > 0) return false;
  return true;
}

}  // namespace

OpenSource openSource(const std::string& given, const std::vector<std::string>& wanted, const OgrErrors& errors) {
  registerDrivers();
  const auto [file, layer_of_file] = splitLayer(given);
  OpenSource source;
  source.name = withoutSecrets(nameOf(file));
  std::vector<std::string> names = wanted;
  if (!layer_of_file.empty()) names = {layer_of_file};
  source.names_layers = !names.empty();
  const std::string path = pathForOgr(file, names);
  constexpr unsigned kHow = GDAL_OF_VECTOR | GDAL_OF_READONLY | GDAL_OF_VERBOSE_ERROR;
  if (std::error_code error; isLineFile(path) && std::filesystem::exists(path, error)) {
    source.dataset = readLineFile(path);
  } else {
    source.dataset.reset(GDALDataset::Open(path.c_str(), kHow));
  }
  if (source.dataset && hasTextsOnly(*source.dataset)) {
    // GDAL knows a column of geometries only as WKT; these are the names that databases and GeoPandas give it.
    const CPLStringList columns(CSLSetNameValue(nullptr, "GEOM_POSSIBLE_NAMES", "geometry,geom,the_geom,wkt_geom"));
    source.dataset.reset(GDALDataset::Open(path.c_str(), kHow, nullptr, columns.List()));
  }
  if (source.dataset) readWaysAsLines(path, names, source.dataset);
  // GDAL opens TELEMAC's meshes, and makes a polygon of each triangle.
  if (!source.dataset || source.dataset->GetDriverName() == std::string_view("Selafin"))
    refuse(source.name, path, errors);

  // The name of a file in an archive also selects its only layer, whatever that layer's name is.
  const bool in_archive = path != file && (path.starts_with("/vsizip/") || path.starts_with("/vsitar/"));
  if (in_archive && names.size() == 1 && names.front() == stemOf(path) && source.dataset->GetLayerCount() == 1)
    names.clear();
  std::vector<std::string> there;
  for (OGRLayer* layer : source.dataset->GetLayers()) {
    there.emplace_back(layer->GetName());
    if (names.empty() || std::ranges::find(names, there.back()) != names.end()) source.layers.push_back(layer);
  }
  for (const std::string& name : names) {
    if (std::ranges::find(there, name) != there.end()) continue;
    throw InputError(sourceInWords(source.name) + ": has no layer '" + name + "'; there " +
                     (there.size() == 1 ? "is " : "are ") + (there.empty() ? "none" : listed(there, kMostListed)));
  }
  return source;
}

bool isStream(const std::string& path) { return isStreamFile(splitLayer(path).first); }

void refuseOddGeojson(const OpenSource& source, const OgrErrors& errors) {
  if (!errors.failed() && errors.leftOut().empty()) return;
  if (source.dataset->GetDriverName() != std::string_view("GeoJSON")) return;
  if (const std::optional<std::string> odd = oddGeojson(source.dataset->GetDescription())) {
    throw InputError("'" + source.name + "', " + *odd + ": repair or remove this feature");
  }
}

void requireReadToEnd(const OpenSource& source, const OgrErrors& errors) {
  refuseOddGeojson(source, errors);
  if (errors.failed())
    throw InputError(sourceInWords(source.name) + ": cannot be read to its end (" + errors.text() + ")");
}

std::uint64_t keepWhere(const OpenSource& source, const std::string& where, OgrErrors& errors) {
  std::uint64_t left_out = 0;
  std::size_t kept = 0;
  std::string reason;
  for (OGRLayer* layer : source.layers) {
    const GIntBig before = layer->GetFeatureCount();
    if (layer->SetAttributeFilter(where.c_str()) != OGRERR_NONE || errors.failed()) {
      if (reason.empty()) reason = errors.text();
      errors.clear();
      layer->SetAttributeFilter("1 = 0");
      left_out += static_cast<std::uint64_t>(std::max<GIntBig>(before, 0));
      continue;
    }
    const GIntBig after = layer->GetFeatureCount();
    if (errors.failed()) {
      throw InputError(sourceInWords(source.name) + ": --where \"" + where + "\" cannot be asked of it (" +
                       errors.text() + ")");
    }
    left_out += static_cast<std::uint64_t>(std::max<GIntBig>(before - after, 0));
    ++kept;
  }
  if (kept > 0) return left_out;
  throw InputError(sourceInWords(source.name) + ": --where \"" + where + "\" cannot be asked of it" +
                   (reason.empty() ? "" : " (" + reason + ")") + fieldsInWords(source));
}

}  // namespace coastmesh
