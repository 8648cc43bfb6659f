#pragma once

#include <cstddef>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/coast/coastline.hpp"
#include "gis/coast/snap_distance.hpp"

namespace coastmesh {

// Groups features that must be meshed together because they touch, cross or contain one another, or come so near that
// cleaning may merge points of both (`snap`); a feature in a hole of another is separate. Water between land and a
// frame is one group, and so is a whole globe. Otherwise constraints, weirs and regions belong to each group that their
// extent meets, frames to each group that is not strictly inside a box of theirs; every other feature is in exactly one
// group. Members ascend, groups are ordered by their first member that is none of these. Longitudes are compared as
// given, except that if they span exactly 360 degrees, the first and the last meridian are the same. O(n log n) for
// features that are far apart. Throws InputError if PROJ cannot place the input on Earth.
std::vector<std::vector<std::size_t>> groupFeatures(const Coastline& coastline, const SnapDistance& snap = {},
                                                    const ItemLoop& loop = inOrder);

}  // namespace coastmesh
