#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "gis/grid/grid.hpp"

namespace coastmesh {

// Names and numbers of regions, features and openings, in files and for what is said of files.

// The names of the grid's regions, sorted; in files they are numbered from 1, and 0 means none.
std::vector<std::string> regionNames(const Grid& grid);
std::vector<int> regionNumbers(const Grid& grid, const std::vector<std::string>& names);  // one for each feature

// A unique name for each feature: "feature 7", "feature 7 (2)" for the second with that number and region, "feature 7
// in Bay" in a region. Quotes and line ends become blanks.
std::vector<std::string> featureLabels(const Grid& grid);

// The feature that such a name stands for; any other name becomes that of a feature `number`.
GridFeature featureOfLabel(const std::string& label, std::int64_t number);

// Replaces quotes and line ends, which would end a quoted name, by blanks.
std::string quotable(std::string_view name);

// "'Elbe' near (9.1, 53.8)"; for an opening without a name "open near …" or "river near …".
std::string openingName(const Boundary& boundary, const Grid& grid);

// Openings that a line for users names at most.
inline constexpr std::size_t kMostOpenings = 12;

// Makes a feature for each combination of fid and region, and assigns each triangle its own. `fids` and `regions` have
// one number for each triangle or are empty; `regions` are numbers into `names` as above. Fids count as not given if
// one of them is NaN or exceeds 2^53 in absolute value. Does nothing if neither is given.
void addFeatures(const std::vector<double>& fids, const std::vector<double>& regions,
                 const std::vector<std::string>& names, Grid& grid);

}  // namespace coastmesh
