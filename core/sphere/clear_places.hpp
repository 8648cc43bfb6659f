#pragma once

#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "core/point.hpp"
#include "core/pslg.hpp"
#include "core/space_point.hpp"
#include "core/surface.hpp"

namespace coastmesh {

// The places, as points in the plane, that are within a convex ring and no closer to its corners, or to a segment or
// point of `pslg`, than the clearance, a length on the surface. REQUIRES: the surface is curved, the ring
// counter-clockwise around the origin, the clearance above 0.
std::vector<Point> clearPlaces(std::span<const SpacePoint> places, const Pslg& pslg, std::span<const Point> ring,
                               const Surface& surface, double clearance, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
