#pragma once

#include <vector>

#include "apps/vector_output.hpp"
#include "gis/clean.hpp"
#include "gis/read_coastline.hpp"

namespace coastmesh {

// Cleaned domains as layers that `readCleaned` makes the same domains of, with all that is known of their features: see
// gis/cleaned_layers.hpp. Edges come in the order of their places.
std::vector<VectorLayer> cleanedLayers(const std::vector<Domain>& domains, const CleanReport& report,
                                       const Coastline& coastline, const ReadReport& read);

}  // namespace coastmesh
