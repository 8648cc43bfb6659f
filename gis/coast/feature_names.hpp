#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gis/coast/coastline.hpp"

namespace coastmesh {

// The value of the attribute "name", else of the first that has "name" in its own; in capitals or not. Empty: none.
std::string_view nameOf(const std::vector<std::pair<std::string, std::string>>& attributes);

// Whether an attribute may be meant: "name" is in its own.
bool isNameAttribute(std::string_view attribute);

// A place as notes and errors say it: "-87.5, 41.25".
std::string placeInWords(const Point& place);

// What a region is called: its attribute "tag", "region" or "name", else the number of its feature.
std::string regionNameOf(const Feature& feature);

// What a line of the feature is called: its name, or that of the region whose border it is. Empty: nothing.
std::string lineNameOf(const Feature& feature);

}  // namespace coastmesh
