#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "core/point.hpp"

namespace coastmesh {

// For hash tables of points: 0 and -0, which are equal, have the same hash.
struct PointHash {
  std::size_t operator()(const Point& p) const {
    const auto bits = [](double value) { return std::bit_cast<std::uint64_t>(value + 0.0); };
    const std::uint64_t mixed = (bits(p.x) ^ std::rotl(bits(p.y), 32)) * 0x9E3779B97F4A7C15ull;
    return static_cast<std::size_t>(mixed ^ mixed >> 29);
  }
};

}  // namespace coastmesh
