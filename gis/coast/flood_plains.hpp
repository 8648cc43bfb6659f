#pragma once

#include <string_view>

#include "gis/coast/coastline.hpp"

namespace coastmesh {

// Flood plains are features of use Area, made by the program, whose inside is meshed besides the water, also where a
// frame has land. The coast within them stays as a line if both of its sides are meshed and it does not follow sizes.
inline constexpr std::string_view kFloodPlainSource = "the flood plain";
inline constexpr std::string_view kFloodedCoast = "coast";  // the name of that line

inline bool isFloodPlain(const Feature& feature) {
  return feature.use == FeatureUse::Area && feature.fid < 0 && feature.source == kFloodPlainSource;
}

// Frames and flood plains are not the user's shapes: changes to them are not reported.
inline bool isReported(const Feature& feature) { return feature.use != FeatureUse::Frame && !isFloodPlain(feature); }

}  // namespace coastmesh
