#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "core/bulk_list.hpp"
#include "core/item_loop.hpp"
#include "core/size_function.hpp"
#include "core/tri_mesh.hpp"
#include "gis/geometry/box_tree.hpp"
#include "gis/shore/even_sizes.hpp"
#include "gis/shore/shore_graph.hpp"

namespace coastmesh {

// What a vertex lies on, as bits. kAround: a corner of the surrounding box. kLoose: on no segment, counts as in water.
// kAtLine: a vertex of the shore where a line ends that was set aside.
enum VertexUse : std::uint8_t { kOnShore = 1, kOnOpen = 2, kInWater = 4, kAround = 8, kLoose = 16, kAtLine = 32 };

// A graph as a constrained Delaunay triangulation of both sides of the shores, and of a margin as wide as the domain.
// Opening land or water changes regions of triangles; `settleShores` then updates the rest to the shores that are left.
struct ShoreTriangles {
  TriMesh mesh;                    // regions: those of water, and `land` everywhere else
  RegionId land = 0;               // no region of the graph
  std::vector<std::int32_t> tags;  // of segments that edges are part of; the last: of new ones
  std::vector<VertexId> source;    // of each point: index of the domain's point, or kNone
  std::vector<TriId> home;         // of each point: a triangle around it; kNone if removed
  std::vector<std::uint8_t> use;   // of each point
  std::vector<double> width;       // of each triangle: the diameter of its circumcircle over the size wanted there
  std::vector<double> size;        // of each triangle: the size wanted at its centre
  // If sizes grow evenly with the distance from the shore: their growth, and the size at each point, which determine
  // those of triangles. Otherwise NaN, and empty.
  double rate = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> size_at;
  BulkList<RegionId> region_was;  // `mesh.regions` when last settled
  std::vector<VertexId> helpers;  // temporary points: settling removes those on no segment
  bool is_new = true;             // never settled: water may touch itself anywhere
};

// For each region of water: true if no element fits into its water (`smallWaters`).
using SmallWaters = std::vector<bool>;

// Cuts segments between water and land where another shore, or one of `lines`, is within about the size wanted, so that
// triangles between them are as wide as the water or the land there.
void sampleShores(ShoreGraph& graph, const SizeFunction& size, const BoxTree& lines = {},
                  const ItemLoop& loop = inOrder, const EvenSizes* even = nullptr);

// REQUIRES: a labelled graph.
ShoreTriangles triangulateShores(ShoreGraph&& graph, const SizeFunction& size, const ItemLoop& loop = inOrder,
                                 const EvenSizes* even = nullptr);

// True if v is in the water and on no shore, as vertices of a border of regions.
inline bool isOffShore(const ShoreTriangles& triangles, VertexId v) {
  return (triangles.use[v] & (kInWater | kOnShore | kOnOpen)) == kInWater;
}

// True if a vertex of the triangle is: its width then says nothing of the water's.
inline bool hasOffShore(const ShoreTriangles& triangles, TriId t) {
  const auto& v = triangles.mesh.triangles[t].v;
  return isOffShore(triangles, v[0]) || isOffShore(triangles, v[1]) || isOffShore(triangles, v[2]);
}

// Calls `visit(t)` for the triangles around v, counter-clockwise. REQUIRES: v is not kAround.
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

// The `VertexUse` bits of a vertex, from the segments that end in it.
std::uint8_t useOf(const ShoreTriangles& triangles, VertexId v);

// REQUIRES: settled.
ShoreGraph graphOf(const ShoreTriangles& triangles);

}  // namespace coastmesh
