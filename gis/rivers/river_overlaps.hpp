#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/point.hpp"
#include "gis/rivers/river_junctions.hpp"
#include "gis/rivers/river_rows.hpp"

namespace coastmesh {

// Two reaches whose rows have places in common; the same one twice if it overlaps itself.
struct RiverOverlap {
  std::uint32_t first = 0, second = 0;
  Point place;
  std::vector<std::size_t>
      rows;  // of a reach that overlaps itself, ascending; none if it overlaps a junction of its own
};

// Overlaps of rows with others, and with the banks of junctions, for which one of their branches stands. Each pair of
// reaches is there once, in the order of their numbers. Reaches without rows take no part.
// `clearance`: rows of different places also overlap if they are nearer to one another than this share of the longer
// one's length.
std::vector<RiverOverlap> overlapsOf(std::span<const RiverRows> rows, std::span<const RiverJunction> junctions,
                                     double clearance);

}  // namespace coastmesh
