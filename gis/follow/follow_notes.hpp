#pragma once

#include <string>
#include <vector>

#include "gis/follow/follow_options.hpp"
#include "gis/follow/shore_opening.hpp"
#include "gis/projection/projection.hpp"

namespace coastmesh {

// What people should know of a shore that was made to follow sizes.
struct FollowNotes {
  std::vector<CutOffWater> cut_off;
  std::vector<ClosedStrait> straits;
  std::vector<WidenedPassage> widened;
  std::vector<std::size_t> dry;  // passages that meet no water
};

// Sentences that name the largest, with their places in the input's CRS.
std::vector<std::string> notesOf(FollowNotes&& notes, const ShoreGuides& guides, const FollowOptions& options,
                                 const Projection& projection);

}  // namespace coastmesh
