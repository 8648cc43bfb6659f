#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gis/coast/coastline.hpp"
#include "gis/geometry/box.hpp"

namespace coastmesh {

// A source, and the use of its features.
struct Source {
  // Anything that OGR opens: a file, "file|layer", a folder, a URL, "/vsizip/…"; archives (.zip, .gz, .tar) are
  // searched, and "-" is standard input.
  std::string path;
  FeatureUse use = FeatureUse::Area;
};

// Which features are read from the sources with FeatureUse::Area.
struct ReadFilter {
  std::vector<std::string> layers;  // only layers of these names; empty: all
  std::string where;                // only features that satisfy this SQL condition; empty: all
  std::optional<Box> near{};        // in degrees: features that are not near it may be left out, see `keepNear`
  bool unsaid_in_plane = false;     // if no source says a CRS that is known, all are in a plane, degrees or not
};

}  // namespace coastmesh
