#pragma once

#include <string>
#include <vector>

#include "gis/coast/join_lines.hpp"
#include "gis/coast/snap_distance.hpp"
#include "gis/crs/crs.hpp"

namespace coastmesh {

// A pair of ends that were made one.
struct ClosedGap {
  Point from, to;  // the end that moved, and its new place
};

// Joins lines like `joinLines`, and then also the ends that no other line meets and that are within the snap distance
// of one another, the nearest first. The later end of a pair moves to the place of the other. Adds such pairs to
// `gaps`. O(n log n) unless many ends are within reach of one another.
JoinedLines joinAcrossGaps(const std::vector<std::vector<Point>>& lines, const SnapDistance& snap, const Crs& crs,
                           std::vector<ClosedGap>& gaps);

}  // namespace coastmesh
