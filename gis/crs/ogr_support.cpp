#include "gis/crs/ogr_support.hpp"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <gdal.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <exception>
#include <memory>
#include <string_view>
#include <utility>

#include "gis/error.hpp"

namespace coastmesh {

namespace {

// Fragments of the messages of several GDAL versions. They may match too much: callers then search the file themselves.
bool saysLeftOut(std::string_view message) {
  if (message.find("GeoJSON: ") == message.npos) return false;
  constexpr std::array<std::string_view, 5> kWords = {"failure", "nvalid", "nsupported", "null object", "issing"};
  return std::ranges::any_of(kWords, [&](std::string_view word) { return message.find(word) != message.npos; });
}

}  // namespace

OgrErrors::OgrErrors() : OgrErrors(std::function<std::string()>()) {}

OgrErrors::OgrErrors(std::function<std::string()> reason) : reason_(std::move(reason)) {
  CPLPushErrorHandlerEx(
      [](CPLErr severity, CPLErrorNum code, const char* message) { collect(severity, code, message); }, this);
}

OgrErrors::~OgrErrors() { CPLPopErrorHandler(); }

void OgrErrors::collect(int severity, int, const char* message) {
  auto* self = static_cast<OgrErrors*>(CPLGetErrorHandlerUserData());
  if (severity == CE_Fatal) std::terminate();  // out of memory; GDAL would abort the process
  // GDAL may quote a whole file or statement.
  constexpr std::size_t kLongest = 300;
  if (severity == CE_Debug && self->left_out_.empty() && saysLeftOut(message)) {
    self->left_out_ = oneLine(message, kLongest);
  }
  if (severity < CE_Warning) return;
  // PROJ tries forms of a CRS one after another, and calls it an error that one does not suit: WKT 1 for Equal Earth or
  // for a datum shift by a grid, which it also looks for. What reads and writes features needs neither.
  constexpr std::string_view kOfProj = "PROJ: ";
  const bool of_proj = std::string_view(message).starts_with(kOfProj);
  const bool error = severity >= CE_Failure && !of_proj;
  if (self->text_.empty() || (self->of_proj_ && !of_proj) || (error && !self->failed_)) {
    const std::string reason = error && self->reason_ ? self->reason_() : "";
    self->text_ = reason.empty() ? oneLine(message, kLongest) : reason;
    self->of_proj_ = of_proj;
  }
  self->failed_ = self->failed_ || error;
}

void OgrErrors::clear() {
  failed_ = of_proj_ = false;
  text_.clear();
  left_out_.clear();
}

void registerDrivers() { [[maybe_unused]] static const bool registered = (GDALAllRegister(), true); }

OgrOption::OgrOption(const char* name, const char* value) : name_(name) {
  const char* before = CPLGetThreadLocalConfigOption(name, nullptr);
  was_set_ = before != nullptr;
  if (was_set_) before_ = before;
  CPLSetThreadLocalConfigOption(name, value);
}

OgrOption::~OgrOption() { CPLSetThreadLocalConfigOption(name_, was_set_ ? before_.c_str() : nullptr); }

OGRSpatialReference toOgr(const Crs& crs) {
  assert(!crs.isPlane());
  const OgrErrors caught;  // of grids of a datum shift that are not installed: the CRS is as given without them
  OGRSpatialReference srs;
  srs.SetFromUserInput(crs.authority.empty() ? crs.wkt.c_str() : crs.authority.c_str());
  srs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return srs;
}

}  // namespace coastmesh
