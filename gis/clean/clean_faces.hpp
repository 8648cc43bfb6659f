#pragma once

#include <vector>

#include "core/pslg.hpp"
#include "gis/clean/clean_nodes.hpp"

namespace coastmesh {

// Edges that separate two labels, and lines inside the domain, from the lower to the higher vertex, sorted; and
// requested vertices that lie on none of them.
struct LabelledEdges {
  std::vector<Segment> segments;  // tagged: see segment_tags.hpp
  std::vector<VertexId> points;
  std::vector<VertexId> asked;    // all requested vertices
  std::vector<VertexId> traces;   // vertices of edges that were dissolved, ascending
  std::vector<DomainLine> lines;  // the lines that tags refer to
  RegionId beyond = kOutside;     // the label outside all edges
};

// Labels the faces between noded edges: a face belongs to the first feature that contains it by the even-odd rule,
// within the frame if there is one; framed water belongs to the frame. With `dissolve`, features that share an edge are
// united into the first of them. Dropped edges and points are reported. Throws InputError if coasts do not determine
// which side is water, and NothingWanted if the requested water is outside of all that coasts or the frame enclose.
LabelledEdges labelFaces(const CleanChains& chains, const NodedEdges& edges, const Coastline& coastline,
                         const Projection& projection, bool dissolve, CleanReport& report,
                         const ItemLoop& loop = inOrder);

// Lines that close no ring (open_lines.cpp) ---------------------------------------------------------------------------

// Open lines among the features to mesh are edges where they are in the water, and left out elsewhere. Such a line may
// be a wharf, but also the shore of an island or a lake with a gap, which would be lost in silence: notes count them,
// and a warning names those whose ends almost meet, with the snap distance that joins them.
void reportOpenLines(const Coastline& coastline, const CleanChains& chains, const LabelledEdges& labelled,
                     const Projection& projection, CleanReport& report);

}  // namespace coastmesh
