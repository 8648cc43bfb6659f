#pragma once

#include <cstdint>

namespace coastmesh {

using VertexId = std::uint32_t;
using TriId = std::uint32_t;
using SegmentId = std::uint32_t;

// The source feature of a triangle, or of a side of a segment.
using RegionId = std::int32_t;

// The one sentinel: no vertex, no triangle, no segment, no edge.
inline constexpr std::uint32_t kNone = 0xFFFFFFFFu;

inline constexpr RegionId kOutside = -1;     // outside the domain: not meshed
inline constexpr RegionId kUnlabelled = -2;  // unspecified; decided by hole seeds and the outer boundary

}  // namespace coastmesh
