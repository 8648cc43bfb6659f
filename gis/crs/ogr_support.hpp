#pragma once

#include <ogr_spatialref.h>

#include <functional>
#include <string>

#include "gis/crs/crs_definition.hpp"

namespace coastmesh {

// Collects GDAL's messages in this thread during its lifetime, so that none reaches stderr.
class OgrErrors {
 public:
  OgrErrors();
  // Asks `reason` at the first error, before GDAL tidies up: if it knows one, that is the text instead of GDAL's.
  explicit OgrErrors(std::function<std::string()> reason);
  ~OgrErrors();
  OgrErrors(const OgrErrors&) = delete;
  OgrErrors& operator=(const OgrErrors&) = delete;

  // True after an error (not a warning, and none of PROJ) since the start or `clear`.
  bool failed() const { return failed_; }
  const std::string& text() const { return text_; }  // the first error, else the first message, as one short line
  bool isOfProj() const { return of_proj_; }         // true if `text` is on a CRS alone, so that features are unharmed
  // The first message of the GeoJSON driver on a geometry, or part of one, that it drops. It is only a debug message,
  // which GDAL issues if CPL_DEBUG is "GeoJSON".
  const std::string& leftOut() const { return left_out_; }
  void clear();

 private:
  static void collect(int severity, int code, const char* message);

  bool failed_ = false, of_proj_ = false;
  std::string text_;
  std::string left_out_;
  std::function<std::string()> reason_;
};

// Sets a GDAL configuration option in this thread during its lifetime.
class OgrOption {
 public:
  OgrOption(const char* name, const char* value);
  ~OgrOption();
  OgrOption(const OgrOption&) = delete;
  OgrOption& operator=(const OgrOption&) = delete;

 private:
  const char* name_;
  std::string before_;
  bool was_set_;
};

// Registers GDAL's drivers. GDALAllRegister itself goes through all of them at every call, which takes as long as
// opening a small file; here only the first call does so.
void registerDrivers();

// With x = easting or longitude. REQUIRES: not a plane.
OGRSpatialReference toOgr(const Crs& crs);

}  // namespace coastmesh
