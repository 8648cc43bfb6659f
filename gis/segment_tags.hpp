#pragma once

#include <cstdint>

namespace coastmesh {

// What a segment of a `Domain` is, as its `Segment::tag`. Markers of a .poly, which are the user's own, are small numbers;
// a shore has 0.
inline constexpr std::int32_t kOpenTag = 0x40000000;        // on the frame's rim: open water goes on beyond
inline constexpr std::int32_t kConstraintTag = 0x40000001;  // a line that the user asked for, with water on both sides
inline constexpr std::int32_t kWeirTag = 0x40000002;        // the same, a weir
inline constexpr std::int32_t kRegionTag = 0x40000003;      // the same, between regions

}  // namespace coastmesh
