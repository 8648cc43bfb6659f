#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "apps/cli/vector_output.hpp"
#include "gis/clean/clean.hpp"
#include "gis/read/read_coastline.hpp"

namespace coastmesh {

// By domain and segment: what the boundary is there, as `kindOfText` takes it. Empty, or empty texts, where nothing is
// known.
using BoundaryTypes = std::vector<std::vector<std::string>>;

// What was changed, now or when the file was cleaned before, as points: the same edit found again counts once.
// `source_of` says where a feature of the coastline was read.
VectorLayer editLayer(std::span<const Edit> edits, const std::function<std::string(std::uint32_t)>& source_of,
                      const ReadReport& read);

// Cleaned domains as layers that `readCleaned` makes the same domains of, with all that is known of their features: see
// gis/read/cleaned_layers.hpp. Edges come in the order of their places.
std::vector<VectorLayer> cleanedLayers(const std::vector<Domain>& domains, const CleanReport& report,
                                       const Coastline& coastline, const ReadReport& read, const BoundaryTypes& types);

}  // namespace coastmesh
