#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "gis/grid/grid.hpp"

namespace coastmesh {

// Regions and features as formats with numbers and names have them.

// The names of the grid's regions, sorted; their numbers in files are counted from 1, 0 being none.
std::vector<std::string> regionNames(const Grid& grid);
std::vector<int> regionNumbers(const Grid& grid, const std::vector<std::string>& names);  // one a feature

// One name a feature, no two alike: "feature 7", "feature 7 (2)" where another source has that number too, "feature 7
// in Bay" in a region. Quotes and ends of lines become blanks.
std::vector<std::string> featureLabels(const Grid& grid);

// The feature that such a name names; another name becomes that of a feature `number`.
GridFeature featureOfLabel(const std::string& label, std::int64_t number);

// Without what ends a name in quotes: these, and ends of lines.
std::string quotable(std::string_view name);

// Gives the grid a feature for each fid and region and each triangle its own, both given one a triangle; `regions` are
// numbers into `names` as above, and empty where there are none. Does nothing where neither is given, or fids are none:
// not a number, or past the whole numbers that a double has.
void addFeatures(const std::vector<double>& fids, const std::vector<double>& regions,
                 const std::vector<std::string>& names, Grid& grid);

}  // namespace coastmesh
