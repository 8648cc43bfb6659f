#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gis/coast/coastline.hpp"

namespace coastmesh {

// The value of the attribute "name", else of the first with "name" in its own name; case-insensitive. Empty if none.
std::string_view nameOf(const std::vector<std::pair<std::string, std::string>>& attributes);

// True if `nameOf` may use the attribute: its name contains "name".
bool isNameAttribute(std::string_view attribute);

// "'lakes.gpkg'": a file, or a layer of it, as a whole.
std::string sourceInWords(const std::string& source);

// "'lakes.gpkg', feature 12", and the same for features that are meshed together: "… and 3 meshed with it". Without a
// number for a source that has no features, such as a .poly.
std::string featureInWords(const Feature& feature);
std::string featureInWords(const std::string& source, std::int64_t fid);
std::string featuresInWords(const Coastline& coastline, const std::vector<std::size_t>& members);

// The name of a region: its attribute "tag", "region" or "name", else the number of its feature.
std::string regionNameOf(const Feature& feature);

// The name of a line of the feature: its own, or that of the region that it borders. Empty if none.
std::string lineNameOf(const Feature& feature);

}  // namespace coastmesh
