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
// pipes, archives (.zip, .tar, .tgz, .gz) by their plain names, and "file|layer" or "file|layername=layer" for one
// layer of a file. `layers` names those wanted; empty: all. Throws InputError: no such file, empty, no vector file, no
// such layer.
OpenSource openSource(const std::string& path, const std::vector<std::string>& layers, const OgrErrors& errors);

// Leaves in each layer what `where` holds for, and gives how many features that leaves out. Layers that lack one of its
// fields are left out whole. Throws InputError where that is all of them.
std::uint64_t keepWhere(const OpenSource& source, const std::string& where, OgrErrors& errors);

}  // namespace coastmesh
