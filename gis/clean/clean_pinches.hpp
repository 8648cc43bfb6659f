#pragma once

#include <vector>

#include "core/pslg.hpp"
#include "gis/clean/clean_chains.hpp"

namespace coastmesh {

// A pinch is a vertex where the outside of the domain lies in two sectors or more, so that water touches itself there.

// Reports every pinch in a vertex of the input; one that was made where edges cross was reported as a crossing.
void reportPinches(const CleanVertices& vertices, const std::vector<Segment>& segments, const Coastline& coastline,
                   CleanReport& report);

// Lets water pass at every pinch. The widest of the sectors outside keeps the vertex, one at an open boundary before
// others; in each of the others the corner gives way, by kPinchGap times the shortest edge at the vertex (less where
// something else is near, more than the gap of `resolution`, which what is new keeps from all else): from a place on
// one of its edges, or that edge's other end, by a new vertex on the corner's bisector, to the other edge. What is
// opened belongs to the water beside it; where that is of two features, they meet in an edge across the gap. Vertices
// as near as a few such gaps are passed by, and a ring that is no larger goes, be it island or lake. No edge meets
// another but in a common end after this as before; new vertices are appended. A pinch without room for that stays, is
// reported as a touching ring, and noted.
inline constexpr double kPinchGap = 0.05;
std::vector<Segment> openPinches(CleanVertices& vertices, std::vector<Segment> segments, const Coastline& coastline,
                                 const Projection& projection, const Resolution& resolution, CleanReport& report);

}  // namespace coastmesh
