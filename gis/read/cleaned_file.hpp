#pragma once

#include <optional>
#include <vector>

#include "gis/read/cleaned_layers.hpp"
#include "gis/read/open_source.hpp"
#include "gis/read/raw_layer.hpp"
#include "gis/read/read_report.hpp"

namespace coastmesh {

// Reads such a file back: what lies to the left and right of its edges makes areas, with the numbers of their features;
// open edges, constraints, weirs and vertices come with their uses, and edits that were made before go to
// `report.edits`. None where the file is no such file. `errors` must have begun before the source was opened. Throws
// InputError: written by an older version, damaged, a shape with a vertex that is no place.
std::optional<std::vector<RawLayer>> readCleaned(const OpenSource& source, const OgrErrors& errors, ReadReport& report);

}  // namespace coastmesh
