#pragma once

#include <cstddef>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/coast/coastline.hpp"

namespace coastmesh {

// Features that touch, cross or contain one another have to be meshed as one; one that lies in a hole of another does
// not. Water between land and a frame is one whatever lies in it; frames, constraints and regions belong to each group
// that their extent meets. All of a whole globe is one group. Every feature is in one group; members ascend, groups are
// ordered by their first member. Longitudes are taken as given, but where they span exactly 360 degrees, the first and
// the last meridian are one. Cost O(n log n) for features that lie apart.
std::vector<std::vector<std::size_t>> groupFeatures(const Coastline& coastline, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
