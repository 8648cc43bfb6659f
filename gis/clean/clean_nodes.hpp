#pragma once

#include <vector>

#include "gis/clean/clean_chains.hpp"

namespace coastmesh {

// One pass of a chain along an edge, in the chain's direction.
struct EdgeUse {
  VertexId a = kNone, b = kNone;
  std::uint32_t chain = 0;

  VertexId low() const { return std::min(a, b); }
  VertexId high() const { return std::max(a, b); }
};

// Edges that meet only in common end points.
struct NodedEdges {
  // Sorted by low end, high end, rings before lines, use of lines, feature. The rings of a feature use an edge at most
  // once (two uses cancel: even-odd), lines of one FeatureUse at most once.
  std::vector<EdgeUse> uses;
  std::vector<char> crossed;  // by chain: true if one of its edges crossed another edge
};

// Inserts vertices where edges cross, and leads edges through the vertices that lie on them (within the snap distance),
// until edges meet only in common end points, exactly. New vertices are appended to `chains.vertices`. New edges are
// led through vertices, and edges through new vertices, within the snap distance, as long as this terminates (if three
// vertices are little more than that apart, an edge between two may stay closer to the third: by a seventh, seldom up
// to a half); after that the grain of `chains.resolution` is used. Throws InputError if that does not terminate.
NodedEdges nodeChains(CleanChains& chains, const Coastline& coastline, const Projection& projection,
                      CleanReport& report, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
