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

// Edges that meet in common end points only.
struct NodedEdges {
  // Sorted by low end, high end, rings before lines, feature. A feature's rings use an edge once at most (two uses
  // cancel: even-odd), lines of one FeatureUse once at most.
  std::vector<EdgeUse> uses;
  std::vector<char> crossed;  // by chain: whether one of its edges crossed another edge
};

// Puts a vertex where edges cross, and lets edges pass through the vertices that lie on them (nearer than the snap
// distance), until no two edges meet but in a common end point, exactly. New vertices are appended to
// `chains.vertices`. What a new vertex or edge comes nearer to than the snap distance it passes through too, as long as
// that ends (where three vertices stand little more than it apart, an edge between two may stay a seventh nearer to the
// third); after that the grain of `chains.resolution` takes its place. Throws InputError where that comes to no end.
NodedEdges nodeChains(CleanChains& chains, const Coastline& coastline, const Projection& projection,
                      CleanReport& report, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
