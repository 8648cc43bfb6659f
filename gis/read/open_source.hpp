#pragma once

#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "gis/crs/ogr_support.hpp"

namespace coastmesh {

// A vector source, opened, with the layers that are wanted of it.
struct OpenSource {
  std::string name;  // as errors name it
  std::unique_ptr<GDALDataset> dataset;
  std::vector<OGRLayer*> layers;
};

// Opens what OGR knows: files, folders, URLs and its own "/vsi…" paths; besides them "-" for standard input, other
// pipes, archives (.zip, .tar, .tgz, .gz) by their plain names, where a file stands for the layer of its name, and
// "file|layer" or "file|layername=layer" for one layer of a file. `layers` names those wanted; empty: all. Throws
// InputError: no such file, empty, no vector file, no such layer, several files in an archive and none named.
OpenSource openSource(const std::string& path, const std::vector<std::string>& layers, const OgrErrors& errors);

// Whether such a path, with a layer or without, can be read but once: standard input or another pipe.
bool isStream(const std::string& path);

// Throws InputError where OGR dropped a geometry of GeoJSON, or part of one: it does so silently, or reports the error,
// but not the feature. To notice all of them, CPL_DEBUG has to be "GeoJSON".
void refuseOddGeojson(const OpenSource& source, const OgrErrors& errors);

// Throws InputError where reading failed since `errors` began: OGR then gives what it has, as if that were all.
void requireReadToEnd(const OpenSource& source, const OgrErrors& errors);

// Leaves in each layer what `where` holds for, and gives how many features that leaves out. Layers that lack one of its
// fields are left out whole. Throws InputError where that is all of them.
std::uint64_t keepWhere(const OpenSource& source, const std::string& where, OgrErrors& errors);

}  // namespace coastmesh
