#include "gis/read/geojson_crs.hpp"

#include <cpl_vsi.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "gis/coast/feature_names.hpp"
#include "gis/crs/known_code.hpp"
#include "gis/lower_case.hpp"
#include "gis/read/file_bytes.hpp"

namespace coastmesh {

namespace {

using Json = nlohmann::json;

// True if the member may be in the file. It is near one of its ends, before or after the features, in every file that
// has few other members.
bool mayHaveCrs(const std::string& path) {
  const std::unique_ptr<VSILFILE, int (*)(VSILFILE*)> file(VSIFOpenL(path.c_str(), "rb"), VSIFCloseL);
  if (!file || VSIFSeekL(file.get(), 0, SEEK_END) != 0) return false;
  constexpr vsi_l_offset kBytes = 1 << 16;
  const vsi_l_offset size = VSIFTellL(file.get());
  for (const vsi_l_offset from : {vsi_l_offset{0}, size - std::min(size, kBytes)}) {
    std::string bytes(kBytes, '\0');
    if (VSIFSeekL(file.get(), from, SEEK_SET) != 0) return false;
    bytes.resize(VSIFReadL(bytes.data(), 1, bytes.size(), file.get()));
    if (bytes.find("\"crs\"") != std::string::npos) return true;
  }
  return false;
}

// Ends the parsing of a file.
struct FoundCrs : std::exception {
  explicit FoundCrs(Json found) : crs(std::move(found)) {}

  Json crs;
};

// The member of the file's outermost object. nullopt if there is none, or the file is not one JSON text.
std::optional<Json> crsMember(const std::string& path) {
  if (!mayHaveCrs(path)) return std::nullopt;
  bool is_crs = false;
  const auto keep = [&](int depth, Json::parse_event_t event, Json& parsed) {
    using Event = Json::parse_event_t;
    if (event == Event::key && depth == 1) is_crs = parsed == "crs";
    if (is_crs && depth == 1 && (event == Event::value || event == Event::object_end))
      throw FoundCrs(std::move(parsed));
    return is_crs || depth == 0;
  };
  FileBytes file(path, static_cast<std::uintmax_t>(1) << 18);
  try {
    [[maybe_unused]] const Json rest = Json::parse(ByteIterator(&file), ByteIterator(nullptr), keep, false);
  } catch (FoundCrs& found) {
    return std::move(found.crs);
  }
  return std::nullopt;
}

// Links, which OGR reports itself if it cannot follow them, are not looked at.
bool isKnown(const Json& crs) {
  if (crs.is_null()) return true;
  if (!crs.is_object()) return false;
  const Json type = crs.value("type", Json()), properties = crs.value("properties", Json());
  if (!type.is_string() || !properties.is_object()) return false;
  const std::string kind = lowerCase(type.get<std::string>());
  if (kind == "name") {
    const Json name = properties.value("name", Json());
    return name.is_string() && isKnownCode(name.get<std::string>());
  }
  if (kind == "epsg") {
    const Json code = properties.value("code", Json());
    return code.is_number_integer() && isKnownCode("EPSG:" + code.dump());
  }
  return true;
}

// The name, or all of a member without one.
std::string inWords(const Json& crs) {
  if (crs.is_object() && crs.contains("properties") && crs["properties"].is_object()) {
    const Json name = crs["properties"].value("name", Json()), code = crs["properties"].value("code", Json());
    if (name.is_string()) return "'" + name.get<std::string>() + "'";
    if (code.is_number()) return "EPSG:" + code.dump();
  }
  constexpr std::size_t kShown = 80;
  return oneLine(crs.dump(-1, ' ', false, Json::error_handler_t::replace), kShown);
}

}  // namespace

void requireKnownCrs(const OpenSource& source) {
  if (source.dataset->GetDriverName() != std::string_view("GeoJSON")) return;
  const std::optional<Json> crs = crsMember(source.dataset->GetDescription());
  if (!crs || isKnown(*crs)) return;
  throw InputError(sourceInWords(source.name) + ": its member crs names a CRS that PROJ does not know, " +
                   inWords(*crs) +
                   ": correct it, or remove the member if the coordinates are longitudes and latitudes on WGS 84");
}

}  // namespace coastmesh
