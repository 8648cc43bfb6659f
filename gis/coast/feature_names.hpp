#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gis/coast/coastline.hpp"

namespace coastmesh {

// The value of the attribute "name", else of the first with "name" in its own name; case-insensitive. Empty: none.
std::string_view nameOf(const std::vector<std::pair<std::string, std::string>>& attributes);

// Whether an attribute may be used: it has "name" in its name.
bool isNameAttribute(std::string_view attribute);

// A place in the format of notes and errors: "-87.5, 41.25".
std::string placeInWords(const Point& place);

// The same with fewer digits, for a place that one has to look for anyway: some metres, or a unit of a plane's.
std::string roughPlaceInWords(const Point& place);

// The name of a region: its attribute "tag", "region" or "name", else the number of its feature.
std::string regionNameOf(const Feature& feature);

// The name of a line of the feature: its own, or that of the region whose border it is. Empty: none.
std::string lineNameOf(const Feature& feature);

}  // namespace coastmesh
