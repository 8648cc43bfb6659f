#pragma once

#include <span>
#include <vector>

#include "core/tri_mesh.hpp"

namespace coastmesh {

// Replaces an edge by the other diagonal of its two triangles, which keep their slots: for the edge b -> c of triangle
// a b c, with d on the other side, that triangle becomes a b d and the other a d c. The edge must have two triangles.
// Returns false if they do not form a convex quadrilateral.
bool flipEdge(std::span<const Point> points, std::span<Triangle> triangles, EdgeRef e);

// The same if it makes the edge Delaunay; returns false if it already is.
bool flipToDelaunay(std::span<const Point> points, std::span<Triangle> triangles, EdgeRef e);

// Lawson's flips: takes edges off `waiting` until it is empty, flips those that `mayFlip(e)` allows and that are not
// Delaunay, calls `flipped(t, n)` with their two triangles, and adds the four edges around them. REQUIRES: edges that
// may be flipped have two sides.
template <typename MayFlip, typename Flipped>
void flipWaiting(std::span<const Point> points, std::span<Triangle> triangles, std::vector<EdgeRef>& waiting,
                 const MayFlip& mayFlip, const Flipped& flipped) {
  while (!waiting.empty()) {
    const EdgeRef e = waiting.back();
    waiting.pop_back();
    if (!mayFlip(e)) continue;
    const TriId t = triOf(e), n = triOf(triangles[t].adj[indexOf(e)]);
    if (!flipToDelaunay(points, triangles, e)) continue;
    flipped(t, n);
    for (const EdgeRef f : {edgeRef(t, 0), edgeRef(t, 2), edgeRef(n, 0), edgeRef(n, 1)}) waiting.push_back(f);
  }
}

// The same from the given edges, except segments. Returns the triangles that changed, some of them several times.
std::vector<TriId> restoreDelaunay(TriMesh& mesh, std::vector<EdgeRef> edges);

}  // namespace coastmesh
