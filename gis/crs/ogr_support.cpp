#include "gis/crs/ogr_support.hpp"

#include <cpl_conv.h>
#include <cpl_error.h>
#include <gdal.h>

#include <cassert>
#include <exception>
#include <memory>
#include <string_view>

#include "gis/error.hpp"

namespace coastmesh {

OgrErrors::OgrErrors() {
  CPLPushErrorHandlerEx(
      [](CPLErr severity, CPLErrorNum code, const char* message) { collect(severity, code, message); }, this);
}

OgrErrors::~OgrErrors() { CPLPopErrorHandler(); }

void OgrErrors::collect(int severity, int, const char* message) {
  auto* self = static_cast<OgrErrors*>(CPLGetErrorHandlerUserData());
  if (severity == CE_Fatal) std::terminate();  // GDAL would end the process: there is no memory
  if (severity < CE_Warning) return;
  // GDAL may quote all of a file or of a statement.
  constexpr std::size_t kLongest = 300;
  const bool error = severity >= CE_Failure;
  if (self->text_.empty() || (error && !self->failed_)) self->text_ = oneLine(message, kLongest);
  self->failed_ = self->failed_ || error;
}

void OgrErrors::clear() {
  failed_ = false;
  text_.clear();
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
  OGRSpatialReference srs;
  srs.SetFromUserInput(crs.authority.empty() ? crs.wkt.c_str() : crs.authority.c_str());
  srs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return srs;
}

}  // namespace coastmesh
