#include "gis/crs/crs.hpp"

#include <cpl_conv.h>
#include <ogr_spatialref.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "gis/crs/known_code.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"

namespace coastmesh {

namespace {

std::string quotedName(const OGRSpatialReference& srs) {
  const char* name = srs.GetName();
  return std::string("\"") + (name ? name : "unnamed") + "\"";
}

std::string authorityOf(const OGRSpatialReference& srs) {
  const char* name = srs.GetAuthorityName(nullptr);
  const char* code = srs.GetAuthorityCode(nullptr);
  return name && code ? std::string(name) + ":" + code : std::string();
}

// Removes the code of the whole CRS from its text. Parts keep theirs.
void dropAuthority(OGRSpatialReference& srs) {
  OGR_SRSNode* const root = srs.GetRoot();
  const int at = root ? root->FindChild("AUTHORITY") : -1;
  if (at >= 0) root->DestroyChild(at);
}

std::string wktOf(const OGRSpatialReference& srs) {
  char* text = nullptr;
  const char* const options[] = {"FORMAT=WKT2_2019", "MULTILINE=NO", nullptr};
  const OGRErr error = srs.exportToWkt(&text, options);
  std::string wkt = error == OGRERR_NONE && text ? text : "";
  CPLFree(text);
  if (wkt.empty()) throw InputError("the CRS " + quotedName(srs) + " cannot be written as WKT");
  return wkt;
}

}  // namespace

Crs parseCrs(const std::string& text) {
  if (text == "plane") return {};
  OGRSpatialReference srs;
  const OgrErrors errors;
  // No access to files or the network: a mistyped code is an error, not a look-up.
  const char* const options[] = {"ALLOW_NETWORK_ACCESS=NO", "ALLOW_FILE_ACCESS=NO", nullptr};
  if (text.empty() || srs.SetFromUserInput(text.c_str(), options) != OGRERR_NONE) {
    throw InputError("\"" + text + "\" is not a CRS that PROJ knows" +
                     (errors.text().empty() ? "" : " (" + errors.text() + ")") +
                     ": give \"plane\", a code such as EPSG:32616, WKT or a PROJ string");
  }
  if (srs.IsLocal()) return {};
  if (srs.IsGeocentric()) {
    throw InputError("the CRS " + quotedName(srs) + " is geocentric: bring the data to EPSG:4326 first");
  }
  if (srs.IsCompound()) srs.StripVertical();
  srs.DemoteTo2D(nullptr);
  const std::unique_ptr<OGRSpatialReference> base(srs.CloneGeogCS());
  if (!base) throw InputError("the CRS " + quotedName(srs) + " has no longitudes and latitudes, as one of heights");
  Crs crs;
  crs.geographic = srs.IsGeographic();
  if (crs.geographic && std::abs(srs.GetAngularUnits() * 180.0 / std::numbers::pi - 1.0) > 1e-9) {
    throw InputError("the CRS " + quotedName(srs) + " does not measure in degrees: bring the data to EPSG:4326 first");
  }
  crs.semi_major_m = srs.GetSemiMajor();
  const double inverse_flattening = srs.GetInvFlattening();
  crs.flattening = inverse_flattening > 0 ? 1 / inverse_flattening : 0.0;
  crs.authority = authorityOf(srs);
  if (!crs.authority.empty() && crs.authority != text && !isKnownCode(crs.authority)) {
    dropAuthority(srs);
    crs.authority.clear();
  }
  crs.wkt = wktOf(srs);
  return crs;
}

Crs wgs84() {
  static const Crs crs = parseCrs("EPSG:4326");  // PROJ looks it up in a database
  return crs;
}

bool sameCrs(const Crs& a, const Crs& b) {
  if (a.wkt == b.wkt) return true;
  if (a.isPlane() || b.isPlane()) return false;
  const char* const options[] = {"CRITERION=EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS",
                                 "IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES", nullptr};
  const OGRSpatialReference left = toOgr(a), right = toOgr(b);
  return left.IsSame(&right, options);
}

double metresPerUnit(const Crs& crs) {
  if (crs.isPlane()) return 1.0;
  const OgrErrors caught;  // of grids of a datum shift, as in `toOgr`
  return crs.geographic ? crs.semi_major_m * std::numbers::pi / 180.0 : toOgr(crs).GetLinearUnits();
}

std::string unitOf(const Crs& crs) {
  const OGRSpatialReference srs = toOgr(crs);  // owns the name
  const char* name = nullptr;
  const double metres = srs.GetLinearUnits(&name);
  if (metres == 1.0) return "metre";
  return name ? name : "unnamed unit";
}

std::string nameOf(const Crs& crs) {
  if (crs.isPlane()) return "plane";
  if (!crs.authority.empty()) return crs.authority;
  const OGRSpatialReference srs = toOgr(crs);  // owns the name
  const char* name = srs.GetName();
  return name ? name : "unnamed CRS";
}

}  // namespace coastmesh
