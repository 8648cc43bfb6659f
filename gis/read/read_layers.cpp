#include "gis/read/read_layers.hpp"

#include <cpl_string.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

#include "gis/coast/feature_names.hpp"
#include "gis/crs/crs_from_ogr.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"
#include "gis/mesh_layers.hpp"
#include "gis/places.hpp"
#include "gis/read/bare_geojson.hpp"
#include "gis/read/cleaned_file.hpp"
#include "gis/read/geojson_crs.hpp"
#include "gis/read/near_box.hpp"
#include "gis/read/ogr_geometry.hpp"
#include "gis/read/open_source.hpp"
#include "gis/read/osm_ways.hpp"
#include "gis/secrets.hpp"

namespace coastmesh {

namespace {

// True if OGR returns coordinates as y, x, according to the layer's axis mapping.
bool axesSwapped(const OGRSpatialReference& srs) {
  OGRSpatialReference traditional(srs);
  traditional.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return srs.GetDataAxisToSRSAxisMapping() != traditional.GetDataAxisToSRSAxisMapping();
}

// Converts to UTF-8. OGR passes on the bytes of old tables without a stated encoding (a .dbf without .cpg), which is
// mostly that of Windows.
std::string inUtf8(const char* text, bool& guessed) {
  if (CPLIsUTF8(text, -1)) return text;
  guessed = true;
  const std::unique_ptr<char, void (*)(void*)> recoded(CPLRecode(text, "CP1252", CPL_ENC_UTF8), CPLFree);
  return recoded.get();
}

std::vector<std::pair<std::string, std::string>> attributesOf(OGRFeature& feature, bool& guessed) {
  std::vector<std::pair<std::string, std::string>> attributes;
  for (int i = 0; i < feature.GetFieldCount(); ++i) {
    if (!feature.IsFieldSetAndNotNull(i)) continue;
    attributes.emplace_back(inUtf8(feature.GetFieldDefnRef(i)->GetNameRef(), guessed),
                            inUtf8(feature.GetFieldAsString(i), guessed));
  }
  return attributes;
}

// A geometry as PostGIS writes it, with the EPSG code of its CRS in front: "SRID=4326;POINT(1 2)".
struct ExtendedWkt {
  int code = 0;  // 0: none
  std::unique_ptr<OGRGeometry> geometry;
};

// Nullopt if it is no such text.
std::optional<ExtendedWkt> readExtendedWkt(std::string_view text) {
  constexpr std::string_view kMark = "SRID=";
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  const std::size_t end = text.find(';');
  if (end == text.npos || !EQUALN(text.data(), kMark.data(), kMark.size())) return std::nullopt;
  ExtendedWkt read;
  const char* const stop = text.data() + end;
  if (const auto number = std::from_chars(text.data() + kMark.size(), stop, read.code);
      number.ec != std::errc() || number.ptr != stop)
    return std::nullopt;
  OGRGeometry* geometry = nullptr;
  const std::string wkt(text.substr(end + 1));
  const OGRErr error = OGRGeometryFactory::createFromWkt(wkt.c_str(), nullptr, &geometry);
  read.geometry.reset(geometry);
  if (error != OGRERR_NONE || !geometry) return std::nullopt;
  return read;
}

// For text tables: text that is not WKT becomes a missing geometry, and OGR does not report it. Returns extended WKT,
// nullopt for an empty text, and throws InputError for anything else.
std::optional<ExtendedWkt> oddWkt(OGRFeature& feature, const std::string& what) {
  if (feature.GetGeomFieldCount() == 0) return std::nullopt;
  const std::string_view column = feature.GetGeomFieldDefnRef(0)->GetNameRef();
  for (int i = 0; i < feature.GetFieldCount(); ++i) {
    const std::string name = feature.GetFieldDefnRef(i)->GetNameRef();
    if (!EQUAL(name.c_str(), "WKT") && column != "geom_" + name && column != name) continue;
    if (std::optional<ExtendedWkt> read = readExtendedWkt(feature.GetFieldAsString(i))) return read;
    constexpr std::size_t kShown = 60;
    const std::string text = oneLine(feature.GetFieldAsString(i), kShown);
    if (text.find_first_not_of(' ') != text.npos) {
      throw InputError(what + ": its " + name + " is not a geometry (" + text + "): repair or remove this feature");
    }
  }
  return std::nullopt;
}

// Throws InputError with `what` in front.
Crs crsOfCode(int code, const std::string& what) {
  OGRSpatialReference srs;
  if (srs.importFromEPSG(code) != OGRERR_NONE)
    throw InputError(what + ": the CRS of its geometry, SRID " + std::to_string(code) + ", is not known");
  srs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return fromOgr(&srs, what);
}

template <typename Act>
void forEachChain(GeometryParts& parts, Act&& act) {
  for (Polygon& polygon : parts.polygons) {
    act(polygon.outer);
    for (Ring& hole : polygon.holes) act(hole);
  }
  for (auto& line : parts.lines) act(line);
  act(parts.points);
}

// One layer while it is read.
class LayerReader {
 public:
  // `of_texts`: read by the driver CSV.
  LayerReader(OGRLayer& layer, std::string source, FeatureUse use, bool of_texts) : of_texts_(of_texts) {
    raw_.source = std::move(source);
    raw_.use = use;
    const OGRFeatureDefn& table = *layer.GetLayerDefn();
    for (int i = 0; i < table.GetFieldCount(); ++i)
      raw_.columns.push_back(inUtf8(table.GetFieldDefn(i)->GetNameRef(), guesses_));
    const OGRSpatialReference* srs = layer.GetSpatialRef();
    if (!srs || srs->IsEmpty()) return;
    // OGR's name for a GeoPackage's undefined CRS: whether it is degrees is guessed from the coordinates, as elsewhere.
    if (srs->GetName() != nullptr && std::string_view(srs->GetName()) == kUndefinedGeographic) return;
    raw_.crs = fromOgr(srs, sourceInWords(raw_.source));
    swap_axes_ = axesSwapped(*srs);
  }

  LayerReader(const Crs& crs, std::string source, FeatureUse use) {
    raw_.source = std::move(source);
    raw_.use = use;
    raw_.crs = crs;
  }

  void add(OGRFeature& given, ReadReport& report) {
    const OGRGeometry* geometry = given.GetGeometryRef();
    Feature feature;
    feature.fid = given.GetFID() == OGRNullFID ? count_ : given.GetFID();
    feature.source = raw_.source;
    feature.use = raw_.use;
    std::optional<ExtendedWkt> extended;
    if (!geometry && of_texts_) extended = oddWkt(given, featureInWords(feature));
    if (extended) {
      geometry = extended->geometry.get();
      takeCode(extended->code, featureInWords(feature));
    }
    if (!geometry || geometry->IsEmpty()) {
      ++report.skipped_empty;
      return;
    }
    GeometryParts parts;
    takeApart(*geometry, featureInWords(feature), parts);
    if (!parts.empty()) feature.attributes = attributesOf(given, guesses_);
    if (guesses_ && !std::exchange(told_guess_, true))
      report.warnings.push_back(featureInWords(feature) +
                                ": has a text that is not UTF-8; such texts are taken for those of " +
                                "Windows-1252 (a .cpg beside a shapefile says its encoding)");
    add(std::move(parts), std::move(feature), report);
  }

  std::int64_t count() const { return count_; }  // of features with a geometry

  // REQUIRES: `feature` has its source, fid and attributes.
  void add(GeometryParts parts, Feature feature, ReadReport& report) {
    ++count_;
    tally(parts, featureInWords(feature), report);
    forEachChain(parts, [&](std::vector<Point>& chain) {
      for (Point& p : chain) {
        if (swap_axes_) std::swap(p.x, p.y);
        raw_.bounds.add(p);
      }
    });
    if (raw_.use == FeatureUse::Constraint) feature.points = std::move(parts.points);
    if (!parts.lines.empty() || !feature.points.empty()) {
      for (auto& line : parts.lines) raw_.lines.push_back({std::move(line), raw_.line_features.size()});
      raw_.line_features.push_back(feature);
      feature.points.clear();
    }
    if (!parts.polygons.empty()) {
      feature.polygons = std::move(parts.polygons);
      raw_.features.push_back(std::move(feature));
    }
  }

  // `filtered`: other features may have been left out.
  RawLayer finish(bool filtered) {
    if (raw_.use == FeatureUse::Area && !filtered && raw_.columns.empty() && count_ == 1 && raw_.features.size() == 1)
      takeBareApart();
    return std::move(raw_);
  }

 private:
  // The CRS that a geometry states holds for the layer, which has none in a text table.
  void takeCode(int code, const std::string& what) {
    if (code == 0) return;
    if (code_ != 0 && code_ != code)
      throw InputError(what + ": its CRS is SRID " + std::to_string(code) + ", but that of features before it is " +
                       std::to_string(code_) + "; bring all to one");
    if (code_ == 0 && !raw_.crs) raw_.crs = crsOfCode(code, what);
    code_ = code;
  }

  void tally(const GeometryParts& parts, const std::string& what, ReadReport& report) {
    report.points += parts.coordinates;
    report.rings += parts.rings;
    if (raw_.use != FeatureUse::Constraint) report.skipped_points += parts.points.size();
    if (parts.unclosed_place && report.unclosed_rings == 0) {
      report.warnings.push_back(what + ": a ring of a polygon is not closed (it ends at " +
                                placeInWords(*parts.unclosed_place) + "): such rings are closed");
    }
    report.unclosed_rings += parts.unclosed_rings;
  }

  // A single geometry without a table row: its polygons become features.
  void takeBareApart() {
    Feature whole = std::move(raw_.features.front());
    raw_.features.clear();
    raw_.features.reserve(whole.polygons.size());
    for (Polygon& polygon : whole.polygons) {
      Feature& feature = raw_.features.emplace_back();
      feature.fid = whole.polygons.size() > 1 ? static_cast<std::int64_t>(raw_.features.size()) - 1 : whole.fid;
      feature.source = whole.source;
      feature.use = whole.use;
      feature.polygons.push_back(std::move(polygon));
    }
  }

  RawLayer raw_;
  std::int64_t count_ = 0;  // features with a geometry
  bool swap_axes_ = false;
  bool of_texts_ = false;
  int code_ = 0;                               // EPSG, of its geometries; 0: none states one
  bool guesses_ = false, told_guess_ = false;  // that the encoding of a text was guessed, and reported
};

[[noreturn]] void refuseEmpty(const std::string& source, std::uint64_t points) {
  throw InputError(sourceInWords(source) + (points > 0 ? ": holds points only" : ": holds no feature with a geometry") +
                   "; polygons or lines are needed");
}

std::vector<RawLayer> finishAll(std::vector<LayerReader>& readers, bool filtered, const std::string& source,
                                std::uint64_t points) {
  std::vector<RawLayer> raw;
  for (LayerReader& reader : readers) {
    RawLayer finished = reader.finish(filtered);
    if (!finished.empty()) raw.push_back(std::move(finished));
  }
  if (raw.empty()) refuseEmpty(source, points);
  return raw;
}

// A mesh given as a coastline by mistake would make a feature of each triangle. Throws InputError, unless the layer was
// named.
void refuseMesh(const OpenSource& source) {
  if (source.names_layers) return;
  for (OGRLayer* layer : source.layers) {
    const auto has = [row = layer->GetLayerDefn()](std::string_view column) {
      return row->GetFieldIndex(std::string(column).c_str()) >= 0;
    };
    if (!std::ranges::all_of(kCornerColumns, has)) continue;
    const std::string name = layer->GetName();
    throw InputError(sourceInWords(source.name) + ": layer '" + name +
                     "' has the triangles of a mesh, which convert, check, info and " + "plot read; --layer " + name +
                     " takes each as a polygon");
  }
}

}  // namespace

std::vector<RawLayer> readLayers(const Source& given, const ReadFilter& filter, ReadReport& report) {
  const bool filtered = !filter.layers.empty() || !filter.where.empty();
  const std::uint64_t points_before = report.skipped_points;
  std::vector<LayerReader> readers;
  if (std::optional<GeometryParts> bare = filtered ? std::nullopt : readBareGeojson(given.path)) {
    Feature feature;
    feature.source = withoutSecrets(given.path);
    feature.use = given.use;
    readers.emplace_back(wgs84(), feature.source, given.use);
    readers.front().add(std::move(*bare), std::move(feature), report);
    return finishAll(readers, false, given.path, report.skipped_points - points_before);
  }

  OgrErrors errors;
  const OgrOption any_size("OGR_GEOJSON_MAX_OBJ_SIZE", "0");
  const OgrOption what_is_left_out("CPL_DEBUG", "GeoJSON");
  const OpenSource source = openSource(given.path, filter.layers, errors);
  refuseOddGeojson(source, errors);
  if (!filter.unsaid_in_plane) requireKnownCrs(source);
  if (given.use == FeatureUse::Area) refuseMesh(source);
  if (filter.where.empty()) {
    if (std::optional<std::vector<RawLayer>> cleaned = readCleaned(source, given.use, errors, report))
      return std::move(*cleaned);
  }
  if (!filter.where.empty()) report.filtered += keepWhere(source, filter.where, errors);
  const bool only = source.dataset->GetLayerCount() == 1;
  const bool of_texts = source.dataset->GetDriverName() == std::string_view("CSV");
  const bool of_osm = isOsm(*source.dataset);
  for (OGRLayer* layer : source.layers) {
    readers.emplace_back(*layer, only ? source.name : source.name + "|" + layer->GetName(), given.use, of_texts);
  }
  const auto isEmpty = [](const LayerReader& reader) { return reader.count() == 0; };
  const auto readAll = [&] {
    // Through the dataset, not layer by layer: OpenStreetMap files come interleaved.
    source.dataset->ResetReading();
    OGRLayer* layer = nullptr;
    while (
        const std::unique_ptr<OGRFeature> feature{source.dataset->GetNextFeature(&layer, nullptr, nullptr, nullptr)}) {
      const auto at = std::find(source.layers.begin(), source.layers.end(), layer);
      if (at == source.layers.end()) continue;
      if (of_osm) refuseOsmCoast(*feature, source.layers, source.name);
      readers[static_cast<std::size_t>(at - source.layers.begin())].add(*feature, report);
    }
  };
  std::uint64_t not_read = filter.near && filter.where.empty() ? keepNear(source, *filter.near) : 0;
  readAll();
  if (not_read > 0 && std::ranges::all_of(readers, isEmpty)) {
    keepAll(source);
    readAll();
    not_read = 0;
  }
  report.not_read += not_read;
  requireReadToEnd(source, errors);
  if (!errors.text().empty() && !errors.isOfProj())
    report.warnings.push_back(sourceInWords(source.name) + ": " + errors.text());
  if (!errors.leftOut().empty()) {
    report.warnings.push_back(sourceInWords(source.name) + ": something is left out that is not a geometry (" +
                              errors.leftOut() + ")");
  }
  if (!filter.where.empty() && std::ranges::all_of(readers, isEmpty))
    throw InputError(sourceInWords(source.name) + ": --where \"" + filter.where +
                     "\" holds for no feature with a geometry in it" +
                     (of_osm ? "; " + std::string(kHowToReadOsmCoasts) : ""));
  return finishAll(readers, !filter.where.empty() || not_read > 0, source.name, report.skipped_points - points_before);
}

}  // namespace coastmesh
