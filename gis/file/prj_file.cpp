#include "gis/file/prj_file.hpp"

#include <cpl_conv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "gis/crs/crs_from_ogr.hpp"
#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"
#include "gis/file/text_reader.hpp"
#include "gis/file/text_writer.hpp"

namespace coastmesh {

namespace {

std::string prjText(const std::string& path, const Crs& crs) {
  return esriWkt(crs, prjBeside(path), "for a .prj file");
}

}  // namespace

std::string esriWkt(const Crs& crs, const std::string& file, std::string_view place) {
  const OgrErrors errors;
  const char* const options[] = {"FORMAT=WKT1_ESRI", nullptr};
  char* wkt = nullptr;
  const OGRErr result = toOgr(crs).exportToWkt(&wkt, options);
  const std::unique_ptr<char, void (*)(void*)> owner(wkt, CPLFree);
  if (result != OGRERR_NONE || wkt == nullptr || *wkt == '\0')
    throw OutputError("cannot write '" + file + "': the CRS has no form " + std::string(place) + " (" + errors.text() +
                      "); choose .gpkg or .nc");
  return wkt;
}

std::string prjBeside(const std::string& path) {
  return std::filesystem::path(path).replace_extension(".prj").string();
}

void requirePrjForm(const std::string& path, const Crs& crs) {
  if (!crs.isPlane()) prjText(path, crs);
}

bool prjLosesDatumShift(const Crs& crs) {
  if (crs.isPlane()) return false;
  const OgrErrors caught;  // of grids of a datum shift, as in `toOgr`
  const OGRSpatialReference srs = toOgr(crs);
  double shift[7] = {};
  if (srs.GetTOWGS84(shift) == OGRERR_NONE) return std::ranges::any_of(shift, [](double part) { return part != 0.0; });
  return srs.GetExtension("DATUM", "PROJ4_GRIDS") != nullptr;
}

void writePrjBeside(const std::string& path, const Crs& crs) {
  if (crs.isPlane()) return;
  const std::string text = prjText(path, crs);
  TextWriter file(prjBeside(path));
  file << text;
  file.close();
}

Crs readPrjBeside(const std::string& path, const Crs& unsaid) {
  const std::string prj = prjBeside(path);
  if (!std::filesystem::exists(prj)) return unsaid;
  TextReader file(prj);
  std::string wkt;
  while (file.nextLine()) wkt += file.line();
  const std::optional<Crs> crs = crsFromWkt(wkt, "'" + prj + "'");
  if (!crs) throw InputError("'" + prj + "' does not hold a CRS as WKT");
  return *crs;
}

}  // namespace coastmesh
