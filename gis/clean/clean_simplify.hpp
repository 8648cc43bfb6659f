#pragma once

#include <vector>

#include "core/pslg.hpp"
#include "gis/clean/clean_chains.hpp"
#include "gis/clean/clean_faces.hpp"

namespace coastmesh {

// Drops vertices between two segments of the same labels and tag, those that matter least first, as long as every
// vertex dropped stays within `tolerance_m` metres of the segment that replaces it. A vertex goes only where the
// triangle with its two neighbours holds no other vertex, so the segments keep their topology: nothing crosses, no
// island changes sides, no ring vanishes; and where the segment that replaces it keeps `resolution` from all others.
// Junctions, ends of lines, fixed points and pinched vertices stay. After Visvalingam & Whyatt, "Line generalisation by
// repeated elimination of points" (1993), with Douglas & Peucker's distance (1973) in place of the area. Cost O(n log
// n) for shores that are not dense within the tolerance.
std::vector<Segment> simplifyEdges(const CleanVertices& vertices, const LabelledEdges& edges,
                                   const Coastline& coastline, const Projection& projection,
                                   const Resolution& resolution, double tolerance_m, CleanReport& report);

// Drops those of `edges.traces` that lie on the straight line between their neighbours: where polygons were cut apart,
// the cut left a vertex in the shore. What was rounded to decimals when the input was written lies on it to within the
// last of these, at most a centimetre; what has all its digits to within rounding. Topology is kept as above.
std::vector<Segment> dropTraces(const CleanVertices& vertices, const LabelledEdges& edges, const Coastline& coastline,
                                const Projection& projection, const Resolution& resolution, CleanReport& report);

}  // namespace coastmesh
