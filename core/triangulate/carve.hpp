#pragma once

#include <stdexcept>

#include "core/bulk_list.hpp"
#include "core/item_loop.hpp"
#include "core/pslg.hpp"
#include "core/triangulate/triangulation.hpp"

namespace coastmesh {

// Thrown if two segments label the same place differently.
struct LabelClash : std::runtime_error {
  LabelClash(SegmentId s, SegmentId o) : std::runtime_error("contradicting labels"), segment(s), other(o) {}
  SegmentId segment, other;
};

// The region of every triangle, up to the segments around it: from their labels, otherwise from the holes and the
// outside. kOutside for ghosts and where no label reaches. REQUIRES: all segments of the PSLG are in the triangulation.
// Throws LabelClash.
BulkList<RegionId> regionsOf(const Triangulation& triangulation, const Pslg& pslg, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
