#pragma once

#include <string>

#include "core/point.hpp"
#include "gis/coast/coastline.hpp"

namespace coastmesh {

// Places, features and numbers in the format of messages.
std::string pointText(const Point& point);              // "(-87.5, 41.25)"
std::string featureText(const Feature& feature);        // "'lakes.gpkg', feature 12"
std::string amount(const char* format, double number);  // as printf writes it, within 60 characters

}  // namespace coastmesh
