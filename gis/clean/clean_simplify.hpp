#pragma once

#include <vector>

#include "core/pslg.hpp"
#include "gis/clean/clean_chains.hpp"
#include "gis/clean/clean_faces.hpp"

namespace coastmesh {

// Drops vertices between two segments of the same labels and tag, the least important first, as long as every dropped
// vertex stays within `tolerance_m` metres of the segment that replaces it. A vertex is dropped only if the triangle
// with its two neighbours contains no other vertex, so the segments keep their topology: nothing crosses, no island
// changes sides, no ring disappears; and only if the new segment keeps `resolution` from all others, and, within a
// quarter of the tolerance, leaves at least half of the distance to them: narrow water and land keep a width, and no
// lake is flattened. Junctions, ends of lines, requested vertices and pinched vertices stay. After Visvalingam &
// Whyatt, "Line generalisation by repeated elimination of points" (1993), with Douglas & Peucker's distance (1973) in
// place of the area. O(n log n) for shores that are not dense within the tolerance.
std::vector<Segment> simplifyEdges(const CleanVertices& vertices, const LabelledEdges& edges,
                                   const Coastline& coastline, const Projection& projection,
                                   const Resolution& resolution, double tolerance_m, CleanReport& report);

// Drops those of `edges.traces` that lie on the straight line between their neighbours: vertices left in the shore
// where polygons were cut apart. The tolerance is the last decimal to which the input was rounded, at most a
// centimetre, or rounding errors if it has all its digits; it is at most 1 % of the new segment. Topology is kept as
// above.
std::vector<Segment> dropTraces(const CleanVertices& vertices, const LabelledEdges& edges, const Coastline& coastline,
                                const Projection& projection, const Resolution& resolution, CleanReport& report);

}  // namespace coastmesh
