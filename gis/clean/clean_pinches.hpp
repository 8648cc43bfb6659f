#pragma once

#include <vector>

#include "core/pslg.hpp"
#include "gis/clean/clean_chains.hpp"

namespace coastmesh {

// A pinch is a vertex where the outside of the domain has two or more sectors, so that water touches itself.

// Reports every pinch at a vertex of the input; those made where edges cross were reported as crossings.
void reportPinches(const CleanVertices& vertices, const std::vector<Segment>& segments, const Coastline& coastline,
                   CleanReport& report);

// Opens every pinch so that water can pass. The widest outside sector keeps the vertex, preferably one at an open
// boundary. In each of the others the corner recedes by kPinchGap times the shortest edge at the vertex (less if
// something else is near, but more than the gap of `resolution`, which new parts keep from everything): from a point on
// one of its edges, or the other end of that edge, by a new vertex on the bisector of the corner, to the other edge.
// The opened area belongs to the water beside it; if that is of two features, they meet in an edge across the gap.
// Vertices within a few such gaps are skipped, and a ring no larger than that is removed, island or lake. Edges meet
// only in common ends as before; new vertices are appended. A pinch without room for this stays, is reported as a
// touching ring, and noted.
inline constexpr double kPinchGap = 0.05;
std::vector<Segment> openPinches(CleanVertices& vertices, std::vector<Segment> segments, const Coastline& coastline,
                                 const Projection& projection, const Resolution& resolution, CleanReport& report);

}  // namespace coastmesh
