#pragma once

#include <vector>

#include "core/pslg.hpp"
#include "core/size_function.hpp"
#include "core/tri_mesh.hpp"
#include "gis/geometry/box_tree.hpp"

namespace coastmesh {

// A domain's graph while its coast is made to follow sizes.
struct ShoreGraph {
  Pslg pslg;                     // labelled
  std::vector<VertexId> source;  // of each point: the domain's that it is, or kNone
};

inline bool isBoundary(const Segment& s) { return (s.left >= 0) != (s.right >= 0); }
inline RegionId waterOf(const Segment& s) { return s.left >= 0 ? s.left : s.right; }

// Cuts segments between water and land where another shore is about as near as the size wanted, so that triangles
// between them are as wide as the water or the land there. So are those at `lines`.
void sampleShores(ShoreGraph& graph, const SizeFunction& size, const BoxTree& lines = {});

// What a vertex of a graph lies on, as bits.
enum VertexUse : std::uint8_t { kOnShore = 1, kOnOpen = 2, kInWater = 4, kAround = 8 };

// Triangles on both sides of the shores, and as far around as the domain is large.
struct ShoreTriangles {
  TriMesh mesh;                      // regions: of water its own, `land` everywhere else; the graph's segments
  RegionId land = 0;                 // no region of the graph
  std::vector<std::uint8_t> use;     // of each point
  std::vector<double> width;         // of each triangle: the diameter of its circumcircle over the size wanted there
  std::vector<double> size;          // of each triangle: the size wanted at its centre
  std::vector<RegionId> region_was;  // what `mesh.regions` was
};
ShoreTriangles triangulateShores(const ShoreGraph& graph, const SizeFunction& size);

// The graph whose water is what `mesh.regions` say by now. Where water would touch itself in a vertex, all but the
// widest part is given a vertex of its own, a little way inside. Points on no segment stay where they lie in water.
ShoreGraph graphOf(const ShoreGraph& before, const ShoreTriangles& triangles);

// Drops points that were made (no point of the domain) and that no segment uses.
void dropLoosePoints(ShoreGraph& graph);

}  // namespace coastmesh
