#pragma once

#include <vector>

#include "core/pslg.hpp"

namespace coastmesh {

VertexId addPoint(Pslg& pslg, const Point& p);

// The tag is the number of the segment, counted from 1.
void addSegment(Pslg& pslg, VertexId a, VertexId b, RegionId left, RegionId right);

void closeRing(Pslg& pslg, const std::vector<VertexId>& ring, RegionId left, RegionId right);

// Returns the ring's vertices.
std::vector<VertexId> addRing(Pslg& pslg, const std::vector<Point>& points, RegionId left, RegionId right);

}  // namespace coastmesh
