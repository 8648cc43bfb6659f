#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gis/coast/coastline.hpp"
#include "gis/projection/projection.hpp"
#include "gis/size/size_distance.hpp"
#include "gis/size/size_field.hpp"

namespace coastmesh {

// Points, lines and polygons with the size wanted on and in them, in some CRS of their own.
struct SizedFeatures {
  struct Part {
    std::vector<Ring> rings;                // of a polygon, even-odd
    std::vector<std::vector<Point>> lines;  // a point is a line of one
    double size_m = 0.0;
    double rate = 0.0;
  };
  std::vector<Part> parts;
};

// Reads all vector layers of `source`. The attribute `size` (metres, above 0) says what is wanted, the attribute
// `rate`, where there is one, how fast that grows with the distance; else `usual_rate` does. Brings coordinates to
// `crs`; a source without a CRS is taken to be in it. Throws InputError: unreadable, no attribute `size`, a size that
// is not above 0 or a rate below 0, no way between the CRS.
SizedFeatures readSizedFeatures(const std::string& source, const Crs& crs, double usual_rate);

// The fields of such features: inside polygons their size, round all of them what grows with the distance. A line that
// leaves what the projection reaches is left out. `scale` is plane length over metres; distances are those on the
// projection's surface.
std::vector<std::unique_ptr<SizeField>> featureFields(const SizedFeatures& features, const Projection& projection,
                                                      const std::function<double(const Point&)>& scale);

}  // namespace coastmesh
