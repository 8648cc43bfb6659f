#pragma once

#include <string>
#include <vector>

#include "gis/coast/coastline.hpp"

namespace coastmesh {

// A source, and what its features are for.
struct Source {
  // What OGR opens: a file, "file|layer", a folder, a URL, "/vsizip/…"; a .zip, .gz or .tar is looked into, and "-" is
  // standard input.
  std::string path;
  FeatureUse use = FeatureUse::Area;
};

// Which features of the sources with FeatureUse::Area are read.
struct ReadFilter {
  std::vector<std::string> layers;  // only layers of these names; empty: all
  std::string where;                // only features for which this SQL condition holds; empty: all
};

}  // namespace coastmesh
