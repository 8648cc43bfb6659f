#pragma once

#include <optional>
#include <vector>

#include "gis/cleaned_layers.hpp"
#include "gis/open_source.hpp"
#include "gis/read_layers.hpp"

namespace coastmesh {

// Reads such a file back: what lies to the left and right of its edges makes areas, with the numbers of their features; open
// edges, constraints, weirs and vertices come with their uses, and edits that were made before go to `report.edits`. None
// where the file is no such file. Private to gis.
std::optional<std::vector<RawLayer>> readCleaned(const OpenSource& source, ReadReport& report);

}  // namespace coastmesh
