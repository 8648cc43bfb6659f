#include "gis/crs/crs_from_ogr.hpp"

#include <cpl_conv.h>

#include <memory>
#include <string>
#include <string_view>

#include "gis/crs/ogr_support.hpp"

namespace coastmesh {

Crs fromOgr(const OGRSpatialReference* srs) {
  if (srs == nullptr || srs->IsEmpty() || srs->IsLocal()) return {};
  if (srs->GetName() != nullptr && std::string_view(srs->GetName()) == kUndefinedGeographic) return {};
  const auto codeOf = [](const OGRSpatialReference& of) {
    const char* name = of.GetAuthorityName(nullptr);
    const char* code = of.GetAuthorityCode(nullptr);
    return name && code ? std::string(name) + ":" + code : std::string();
  };
  std::string code = codeOf(*srs);
  if (code.empty()) {
    const std::unique_ptr<OGRSpatialReference, void (*)(OGRSpatialReference*)> match(
        srs->FindBestMatch(90, "EPSG", nullptr), [](OGRSpatialReference* found) {
          if (found) found->Release();
        });
    if (match) code = codeOf(*match);
  }
  // MapInfo's has no name, by which matches are weighed.
  if (code.empty() && srs->IsGeographic()) {
    const char* const options[] = {"CRITERION=EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCS",
                                   "IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES", nullptr};
    const OGRSpatialReference known = toOgr(wgs84());
    if (srs->IsSame(&known, options)) return wgs84();
  }
  if (!code.empty()) return parseCrs(code);
  const char* const options[] = {"FORMAT=WKT2", nullptr};
  char* wkt = nullptr;
  srs->exportToWkt(&wkt, options);
  const std::unique_ptr<char, void (*)(void*)> owner(wkt, CPLFree);
  return parseCrs(wkt);
}

}  // namespace coastmesh
