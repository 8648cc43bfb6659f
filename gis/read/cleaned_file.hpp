#pragma once

#include <optional>
#include <vector>

#include "gis/read/cleaned_layers.hpp"
#include "gis/read/open_source.hpp"
#include "gis/read/raw_layer.hpp"
#include "gis/read/read_report.hpp"

namespace coastmesh {

// Reads back a file written by `coastmesh clean`. Areas are made from the features to the left and right of edges, with
// their fids; open edges, constraints, weirs and vertices come with their uses, and edits recorded in the file go to
// `report.edits`. As an Area, its layer pslg alone stands for all of it. Returns nullopt for any other source, and if
// only some layers of it are to be read. REQUIRES: `errors` was constructed before the source was opened. Throws
// InputError: `given_as` is not Area, so that the user has to choose a layer; written by an older version, damaged, a
// vertex that is not finite or out of range.
std::optional<std::vector<RawLayer>> readCleaned(const OpenSource& source, FeatureUse given_as, const OgrErrors& errors,
                                                 ReadReport& report);

}  // namespace coastmesh
