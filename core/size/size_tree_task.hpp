#pragma once

#include "core/item_loop.hpp"
#include "core/size/size_tree.hpp"

namespace coastmesh {

// What a size tree is made from, by the steps in `split_by_bounds`, `size_leaves` and `grade_leaves`.
struct SizeTreeTask {
  const SizeSource& source;
  const SizeTreeOptions& options;
  ItemLoop loop;

  const Surface& surface() const { return options.surface; }
};

// The largest ratio of scale factors within a cell in which sizes change. Slopes in a cell are limited by its smallest
// scale factor, and a cone that grows by `kSizeGrowth` should hardly be steeper, since the excess must be flattened.
inline constexpr double kGradedStretch = 1.06;

}  // namespace coastmesh
