#pragma once

#include <cstddef>
#include <cstdint>

#include "apps/plot/plot_canvas.hpp"

namespace coastmesh {

// Shared by all pictures of meshes.

inline constexpr Color kLand{0.955, 0.950, 0.935};
inline constexpr Color kWater{0.865, 0.925, 0.965};
inline constexpr Color kEdge{0.32, 0.52, 0.68};
inline constexpr Color kEdgeOnColor{0.16, 0.27, 0.36};
inline constexpr Color kShore{0.10, 0.20, 0.32};
inline constexpr Color kBad{0.88, 0.10, 0.10};
inline constexpr Color kPaper{1.0, 1.0, 1.0};
inline constexpr Color kInk{0.15, 0.15, 0.15};
inline constexpr Color kOpen{0.84, 0.15, 0.56};
inline constexpr Color kIsland{0.65, 0.45, 0.04};
inline constexpr Color kRiver{0.00, 0.47, 0.75};
inline constexpr Color kWeir{0.75, 0.27, 0.08};
inline constexpr Color kLine{0.43, 0.20, 0.59};
inline constexpr Color kUnknown{0.80, 0.80, 0.80};

inline constexpr double kStripPx = 44.0;  // below the map: scale bar and legend, at least
inline constexpr double kRampPx = 180.0;  // of a scale of colours, at most
inline constexpr double kTextPx = 13.0;
inline constexpr double kRolePx = 2.2;       // of open boundaries, rivers and weirs
inline constexpr double kEdgeShare = 0.075;  // an edge's width over its length, up to the widest
inline constexpr double kWidestEdgePx = 0.8;
inline constexpr double kShorePx = 1.1;
inline constexpr double kBlurPx = 3.0;  // triangles smaller than this show as a tint, not as lines
// Lines of kEdgeShare of the length of an equilateral triangle's edges cover this share of it.
inline constexpr double kEdgeCover = 3.46 * kEdgeShare;
inline constexpr std::size_t kMostVectorTriangles = 100'000;  // in an .svg; more are drawn as an image in it

inline constexpr double kLeastQuality = 0.6;  // at the bad end of the colours

// From bad to good: red, sand, pale green, blue. Shares from 0 to 1.
Color rampColor(double share);
// From deep to shallow: dark blue, blue, pale green, sand.
Color depthColor(double share);
// Colours that differ much between consecutive numbers: hues turned by the golden section.
Color featureColor(std::size_t feature);
// Of nodes with a number of neighbours other than six.
Color degreeColor(std::uint32_t degree);

}  // namespace coastmesh
