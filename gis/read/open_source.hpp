#pragma once

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"

namespace coastmesh {

// An open vector source with the layers to read.
struct OpenSource {
  std::string name;  // as errors name it
  std::unique_ptr<GDALDataset> dataset;
  std::vector<OGRLayer*> layers;
  bool names_layers = false;  // they were named; otherwise they are all of the source
};

// OGR does not open `file` as a vector source.
struct NotVectorError : InputError {
  NotVectorError(const std::string& of_file, const std::string& text) : InputError(text), file(of_file) {}

  std::string file;
};

// Opens whatever OGR can open: files, folders, URLs and its own "/vsi…" paths. Also opens the files of `line_files`,
// "-" (standard input, as "/vsistdin/" is), other pipes, archives (.zip, .tar, .tgz, .gz) by their plain names or from
// a pipe, in which each file is a layer of its name, and "file|layer" or "file|layername=layer" for one layer of a
// file. `layers`: names of layers to read; empty: all. Throws InputError: no such file, empty, no vector file, no such
// layer, several files in an archive and none named.
OpenSource openSource(const std::string& path, const std::vector<std::string>& layers, const OgrErrors& errors);

// True if such a path, with or without a layer, can be read only once: standard input or another pipe.
bool isStream(const std::string& path);

// Throws InputError if OGR dropped a geometry of GeoJSON, or part of one: OGR does so silently, or with an error that
// does not name the feature. Silent cases are noticed only if CPL_DEBUG is "GeoJSON".
void refuseOddGeojson(const OpenSource& source, const OgrErrors& errors);

// Throws InputError if reading failed since `errors` was constructed: OGR returns the features up to the failure as if
// they were all. Includes `refuseOddGeojson`.
void requireReadToEnd(const OpenSource& source, const OgrErrors& errors);

// Filters each layer by the SQL condition `where` and returns the number of features excluded. Layers that lack one of
// its fields are excluded whole. Throws InputError if that excludes all layers, or OGR cannot evaluate the condition.
std::uint64_t keepWhere(const OpenSource& source, const std::string& where, OgrErrors& errors);

}  // namespace coastmesh
