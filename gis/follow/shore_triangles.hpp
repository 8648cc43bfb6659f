#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "core/item_loop.hpp"
#include "core/size_function.hpp"
#include "core/tri_mesh.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/shore/even_sizes.hpp"
#include "gis/shore/shore_graph.hpp"

namespace coastmesh {

// What a vertex lies on, as bits. What lies on no segment counts as lying in water. A vertex of the shore where a line
// ends that was set aside is kAtLine too.
enum VertexUse : std::uint8_t { kOnShore = 1, kOnOpen = 2, kInWater = 4, kAround = 8, kLoose = 16, kAtLine = 32 };

// A graph as a constrained Delaunay triangulation of both sides of the shores, and of as much around as the domain is
// large. Who opens land or water gives triangles other regions; `settleShores` then makes it what it would be of the
// shores that are left.
struct ShoreTriangles {
  TriMesh mesh;                    // regions: of water its own, `land` everywhere else
  RegionId land = 0;               // no region of the graph
  std::vector<std::int32_t> tags;  // of the segments that edges are pieces of; the last is any that was made
  std::vector<VertexId> source;    // of each point: the domain's that it is, or kNone
  std::vector<TriId> home;         // of each point: a triangle round it; kNone of one that is gone
  std::vector<std::uint8_t> use;   // of each point
  std::vector<double> width;       // of each triangle: the diameter of its circumcircle over the size wanted there
  std::vector<double> size;        // of each triangle: the size wanted at its centre
  // Where sizes grow evenly with the distance from the shore: how fast, and the size of each point, from which those of
  // triangles follow. Else NaN, and nothing.
  double rate = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> size_at;
  std::vector<RegionId> region_was;  // what `mesh.regions` was when all was settled
  std::vector<VertexId> helpers;     // points that are there for a while: those on no segment go when all is settled
  bool is_new = true;                // never settled: water may touch itself anywhere
};

// Cuts segments between water and land where another shore is about as near as the size wanted, so that triangles
// between them are as wide as the water or the land there. So are those at `lines`.
void sampleShores(ShoreGraph& graph, const SizeFunction& size, const BoxTree& lines = {},
                  const ItemLoop& loop = inOrder, const EvenSizes* even = nullptr);

// REQUIRES: a labelled graph.
ShoreTriangles triangulateShores(ShoreGraph&& graph, const SizeFunction& size, const ItemLoop& loop = inOrder,
                                 const EvenSizes* even = nullptr);

// Calls `visit(t)` with the triangles round v, counter-clockwise. REQUIRES: v is no corner of what is around.
template <typename Visit>
void forTrianglesRound(const ShoreTriangles& triangles, VertexId v, Visit&& visit) {
  const TriId first = triangles.home[v];
  TriId t = first;
  do {
    visit(t);
    t = triOf(triangles.mesh.triangle(t).adj[next3(triangles.mesh.cornerOf(t, v))]);
  } while (t != first);
}

// Sets `width` and `size` of a triangle.
void measureTriangle(ShoreTriangles& triangles, TriId t, const SizeFunction& size);

// The bits of a vertex, from the segments that end in it.
std::uint8_t useOf(const ShoreTriangles& triangles, VertexId v);

// REQUIRES: settled.
ShoreGraph graphOf(const ShoreTriangles& triangles);

}  // namespace coastmesh
