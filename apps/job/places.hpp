#pragma once

#include <string>

#include "core/point.hpp"
#include "gis/coast/coastline.hpp"

namespace coastmesh {

// Places and features in the format of messages.
std::string pointText(const Point& point);        // "(-87.5, 41.25)"
std::string featureText(const Feature& feature);  // "'lakes.gpkg', feature 12"

}  // namespace coastmesh
