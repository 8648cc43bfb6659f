#pragma once

#include <cstddef>
#include <cstdint>

namespace coastmesh {

// The meaning of `Segment::tag` in a `Domain`. Markers of a user's .poly file are small numbers; a shore has 0. A line
// inside the domain given by the user has its index in `Domain::lines`, counted from kFirstLineTag.
inline constexpr std::int32_t kOpenTag = 0x40000000;      // an open boundary
inline constexpr std::int32_t kOpenedTag = kOpenTag - 1;  // the same, but coarsened like a shore: by files or depths
inline constexpr std::int32_t kFirstLineTag = kOpenTag + 1;

inline bool isOpenTag(std::int32_t tag) { return tag == kOpenTag || tag == kOpenedTag; }
inline bool isLineTag(std::int32_t tag) { return tag >= kFirstLineTag; }
inline std::int32_t lineTag(std::size_t line) { return kFirstLineTag + static_cast<std::int32_t>(line); }
inline std::size_t lineOfTag(std::int32_t tag) { return static_cast<std::size_t>(tag - kFirstLineTag); }

}  // namespace coastmesh
