#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "apps/report/vector_output.hpp"
#include "gis/clean/clean.hpp"
#include "gis/read/read_coastline.hpp"

namespace coastmesh {

// A type as `kindOfText` takes it, empty if unknown, and the name of an opening, empty if it has none.
struct BoundaryType {
  std::string text, name;
};

// Of each segment, by domain; empty if none is known.
using BoundaryTypes = std::vector<std::vector<BoundaryType>>;

// The edits, of this cleaning and of an earlier one of the file, as points; an edit that is found again counts once.
// `source_of` returns the source of a feature of the coastline.
VectorLayer editLayer(std::span<const Edit> edits, const std::function<std::string(std::uint32_t)>& source_of,
                      const ReadReport& read);

// Cleaned domains as layers from which `readCleaned` makes the same domains, with all that is known of their features:
// see gis/read/cleaned_layers.hpp. Edges are sorted by place.
std::vector<VectorLayer> cleanedLayers(const std::vector<Domain>& domains, const CleanReport& report,
                                       const Coastline& coastline, const ReadReport& read, const BoundaryTypes& types);

}  // namespace coastmesh
