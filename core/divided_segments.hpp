#pragma once

#include <vector>

#include "core/bulk_list.hpp"
#include "core/point.hpp"
#include "core/pslg.hpp"

namespace coastmesh {

// The segments of a PSLG, some of them divided by further points.
struct DividedSegments {
  BulkList<Point> points;
  BulkList<double> spacing;  // of each point, as in VertexNotes
  // Ends below the number of the PSLG's points are those points; the others follow in the order of `points`.
  std::vector<Segment> pieces;
  std::vector<SegmentId> of;  // the segment that each piece is a part of
};

}  // namespace coastmesh
