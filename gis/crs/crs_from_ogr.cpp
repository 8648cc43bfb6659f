#include "gis/crs/crs_from_ogr.hpp"

#include <cpl_conv.h>

#include <memory>
#include <string>
#include <string_view>

#include "gis/crs/known_code.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"

namespace coastmesh {

namespace {

// Throws InputError.
Crs knownOrRead(const OGRSpatialReference* srs) {
  if (srs == nullptr || srs->IsEmpty() || srs->IsLocal()) return {};
  if (srs->GetName() != nullptr && std::string_view(srs->GetName()) == kUndefinedGeographic) return {};
  const auto codeOf = [](const OGRSpatialReference& of) {
    const char* name = of.GetAuthorityName(nullptr);
    const char* code = of.GetAuthorityCode(nullptr);
    return name && code ? std::string(name) + ":" + code : std::string();
  };
  std::string code = codeOf(*srs);
  if (code.empty() || !isKnownCode(code)) {
    code.clear();
    const std::unique_ptr<OGRSpatialReference, void (*)(OGRSpatialReference*)> match(
        srs->FindBestMatch(90, "EPSG", nullptr), [](OGRSpatialReference* found) {
          if (found) found->Release();
        });
    if (match) code = codeOf(*match);
  }
  if (!code.empty()) return parseCrs(code);
  const char* const options[] = {"FORMAT=WKT2", nullptr};
  char* wkt = nullptr;
  srs->exportToWkt(&wkt, options);
  const std::unique_ptr<char, void (*)(void*)> owner(wkt, CPLFree);
  // MapInfo's WGS 84 has no name, and matches are weighted by name.
  const Crs crs = parseCrs(wkt);
  return crs.geographic && sameCrs(crs, wgs84()) ? wgs84() : crs;
}

}  // namespace

Crs fromOgr(const OGRSpatialReference* srs, const std::string& source) {
  try {
    return knownOrRead(srs);
  } catch (const InputError& error) {
    throw InputError(source + ": " + error.what());
  }
}

std::optional<Crs> crsFromWkt(const std::string& wkt, const std::string& source) {
  const OgrErrors errors;
  OGRSpatialReference srs;
  const char* text = wkt.c_str();
  if (srs.importFromWkt(&text) != OGRERR_NONE) return std::nullopt;
  srs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return fromOgr(&srs, source);
}

}  // namespace coastmesh
