#pragma once

#include "core/metric.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// A sector of the domain at a vertex, between two adjacent constraints (segments or the boundary).
struct Sector {
  double angle = 0.0;      // radians; 2 pi for a vertex without constraints
  unsigned triangles = 0;  // triangles in the sector
  EdgeRef right = kNone;   // the constrained edge that leaves the vertex, the sector to its left; kNone if none
  EdgeRef left = kNone;    // the constrained edge that enters the vertex, the sector to its left; kNone if none
};

// The sector that contains corner `i` of triangle `t`. Works on TriMesh and EditMesh.
template <typename Mesh>
Sector sectorAt(const Mesh& mesh, TriId t, unsigned i) {
  const auto& home = mesh.triangle(t);
  const VertexId v = home.v[i];
  const auto closed = [&](EdgeRef e) {
    const Triangle& s = mesh.triangle(triOf(e));
    return s.seg[indexOf(e)] != kNone || s.adj[indexOf(e)] == kNone;
  };
  Sector sector;
  // Walks clockwise to the constraint.
  TriId first = t;
  bool round = false;
  while (true) {
    const EdgeRef out = edgeRef(first, prev3(mesh.cornerOf(first, v)));
    if (closed(out)) {
      sector.right = out;
      break;
    }
    first = triOf(mesh.triangle(first).adj[indexOf(out)]);
    if (first == t) {
      round = true;
      break;
    }
  }
  for (TriId s = first;;) {
    const unsigned c = mesh.cornerOf(s, v);
    const Triangle& tri = mesh.triangle(s);
    sector.angle += angleAt(mesh.point(v), mesh.point(tri.v[next3(c)]), mesh.point(tri.v[prev3(c)]));
    ++sector.triangles;
    const EdgeRef in = edgeRef(s, next3(c));
    if (!round && closed(in)) {
      sector.left = in;
      break;
    }
    s = triOf(tri.adj[indexOf(in)]);
    if (round && s == first) break;
  }
  return sector;
}

// True if the sector that begins at corner `i` of triangle `t`, with a constrained edge to its right, may be too small
// for the bounds or may need splits on shells. Without a maximum angle only sectors up to a right angle qualify, so
// that the others need no trigonometry.
bool mayBeSmall(const TriMesh& mesh, TriId t, unsigned i, const TriangleBound& bound);

}  // namespace coastmesh
