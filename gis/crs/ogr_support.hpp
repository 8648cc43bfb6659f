#pragma once

#include <ogr_spatialref.h>

#include <string>

#include "gis/crs/crs_definition.hpp"

namespace coastmesh {

// Collects GDAL's messages in this thread for as long as it lives, so that none reaches stderr.
class OgrErrors {
 public:
  OgrErrors();
  ~OgrErrors();
  OgrErrors(const OgrErrors&) = delete;
  OgrErrors& operator=(const OgrErrors&) = delete;

  bool failed() const { return failed_; }            // an error, not only warnings, since the start or `clear`
  const std::string& text() const { return text_; }  // the first error, else the first warning: one line, not long
  // The first that the GeoJSON driver says of a geometry that it leaves out, or a part of it: no more than a message
  // for debugging, which GDAL gives where CPL_DEBUG is "GeoJSON".
  const std::string& leftOut() const { return left_out_; }
  void clear();

 private:
  static void collect(int severity, int code, const char* message);

  bool failed_ = false;
  std::string text_;
  std::string left_out_;
};

// Sets a GDAL configuration option in this thread for as long as it lives.
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

// Makes GDAL's drivers known. GDAL itself goes through all of them whenever it is asked, which takes as long as opening
// a small file does; here only the first call does anything.
void registerDrivers();

// With x = easting or longitude. REQUIRES: not a plane.
OGRSpatialReference toOgr(const Crs& crs);

}  // namespace coastmesh
