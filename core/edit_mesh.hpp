#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/bulk_list.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

enum class VertexKind : std::uint8_t {
  Input,    // never moved, never removed
  Segment,  // lies inside an input segment: may only slide along it
  Free,
};

using Corners = std::array<VertexId, 3>;

// One edge of the boundary of a patch of triangles, with the patch to its left.
struct BoundaryEdge {
  VertexId a = kNone;
  VertexId b = kNone;
  EdgeRef beyond = kNone;  // the same edge seen from outside the patch; kNone on the boundary of the mesh
  SegmentId seg = kNone;
};

// Some triangles and their boundary. The boundary of a patch without holes is one loop, in order, counter-clockwise.
struct Patch {
  std::vector<TriId> triangles;
  std::vector<BoundaryEdge> boundary;
};

// New numbers, indexed by the old ones; kNone for removed items.
struct Renumbering {
  std::vector<VertexId> vertex;
  std::vector<TriId> triangle;
};

// Type of a star: closed, open from boundary to boundary, or with more triangles than the given limit.
enum class StarKind { Closed, Open, TooMany };

// The link of a vertex, counter-clockwise: where each of its edges starts, and the triangle there.
struct Ring {
  std::vector<VertexId> corners;
  std::vector<TriId> triangles;
};

// A triangulation that can be edited: compact arrays with free lists. Operations append the triangles that they make or
// change to `touched`.
class EditMesh : private LinkedTriangles {
 public:
  explicit EditMesh(TriMesh&& mesh);
  // The same, for a large mesh.
  EditMesh(TriMesh&& mesh, const ItemLoop& loop);

  // The mesh without dead entries. Input vertices keep their numbers; Steiner points and triangles are reordered so
  // that neighbours are close in memory. Leaves `regions` empty.
  TriMesh release() {
    Renumbering by;
    return release(by, true);
  }
  // The same, and the new numbers; without `along_curve` Steiner points keep their order.
  TriMesh release(Renumbering& by, bool along_curve);  // the mesh is empty afterwards
  // The same for a large mesh, by all threads: without `along_curve`.
  TriMesh releaseOn(const ItemLoop& loop, Renumbering& by);

  const Point& point(VertexId v) const { return points_[v]; }
  std::span<const Point> points() const { return points_; }
  const Point& corner(TriId t, unsigned i) const { return points_[triangles[t].v[i]]; }
  bool isLive(TriId t) const { return triangles[t].v[0] != kNone; }
  bool isLiveVertex(VertexId v) const { return triangle_of_[v] != kNone; }
  VertexKind kind(VertexId v) const { return kinds_[v]; }
  TriId triangleOf(VertexId v) const { return triangle_of_[v]; }
  // The number of triangles with corner v.
  std::size_t trianglesRound(VertexId v) const { return triangles_round_[v]; }
  TriId triangleSlots() const { return static_cast<TriId>(triangles.size()); }
  VertexId vertexSlots() const { return static_cast<VertexId>(points_.size()); }
  std::size_t vertexCount() const { return points_.size() - free_vertices_.size(); }
  VertexId inputVertices() const { return input_vertices_; }

  using LinkedTriangles::apex;
  using LinkedTriangles::cornerOf;
  using LinkedTriangles::origin;
  using LinkedTriangles::segment;
  using LinkedTriangles::target;
  using LinkedTriangles::triangle;
  using LinkedTriangles::twin;
  bool isConstrained(EdgeRef e) const { return segment(e) != kNone || twin(e) == kNone; }

  // Calls `visit` with the edge opposite v in each triangle around it, counter-clockwise from the triangle `home`: once
  // around, or up to the boundary. Visits at most `most`.
  template <typename Visit>
  StarKind walkRound(VertexId v, TriId home, std::size_t most, const Visit& visit) const {
    TriId t = home;
    std::size_t left = most;
    do {
      if (left == 0) return StarKind::TooMany;
      --left;
      const unsigned i = cornerOf(t, v);
      visit(edgeRef(t, i));
      const EdgeRef after = triangles[t].adj[next3(i)];
      if (after == kNone) return StarKind::Open;
      t = triOf(after);
    } while (t != home);
    return StarKind::Closed;
  }

  // The edges opposite v in the triangles around it, counter-clockwise; from boundary to boundary if the star is open.
  // At a pinched vertex: the star with triangleOf(v). If there are more than `most`, only some of the edges.
  StarKind star(VertexId v, std::vector<EdgeRef>& opposite,
                std::size_t most = std::numeric_limits<std::size_t>::max()) const;

  // The same as a ring. Returns false if v has more than `most` triangles, or is on the boundary.
  bool ring(VertexId v, std::size_t most, Ring& ring) const;

  // The triangles around the given vertices and their boundary. REQUIRES: the vertices are connected by edges, and none
  // is on the boundary of the mesh. Returns false if the patch is not a disk.
  bool gatherPatch(std::span<const VertexId> vertices, Patch& patch) const;

  struct Place {
    TriId triangle = kNone;   // contains the point, if no obstacle was met
    EdgeRef blocked = kNone;  // otherwise the subsegment that was met
  };
  // Walks towards x, without crossing segments or the boundary. Both are kNone if the walk does not end.
  Place locate(const Point& x, TriId from) const;

  // The triangles whose circumcircles contain x and that are visible from x, with their boundary in order. REQUIRES: x
  // lies in `start`. Returns false if rounding puts x on or outside the boundary.
  bool findCavity(const Point& x, TriId start, Patch& cavity) const;

  // Fills a cavity with a fan around a new free vertex.
  VertexId insertInCavity(const Point& x, const Patch& cavity, std::vector<TriId>& touched);

  // The same for x on a subsegment: the triangles on both sides, and their boundaries without the subsegment, one after
  // the other.
  bool findSplitCavity(EdgeRef edge, const Point& x, Patch& cavity) const;

  // Splits a subsegment with a new vertex at x, which is on it up to rounding. Returns kNone, and changes nothing, if
  // rounding would invert a triangle.
  VertexId splitSegment(EdgeRef edge, const Point& x, std::vector<TriId>& touched);

  // Replaces the triangles of a patch. `fresh` covers it with the same boundary; edges of `fresh` named by `inner`, in
  // either direction, become subsegments. Vertices in `gone` are removed. Does not restore the Delaunay property.
  void replace(const Patch& patch, std::span<const Corners> fresh, std::span<const VertexId> gone,
               std::vector<TriId>& touched, std::span<const BoundaryEdge> inner = {});

  VertexId addVertex(const Point& x, VertexKind kind);

  // Moves a vertex. REQUIRES: every triangle of its star stays counter-clockwise. Does not restore the Delaunay
  // property.
  void setPoint(VertexId v, const Point& to) { points_[v] = to; }

  // Lawson's flips, starting with all edges of the triangles in `touched`; appends the triangles that change.
  void restoreDelaunay(std::vector<TriId>& touched);

  // The same if `touched` is the closed star of v. `spokes_are`: the edges from v certainly are Delaunay.
  void restoreDelaunayRound(VertexId v, std::vector<TriId>& touched, bool spokes_are = false);

 private:
  TriId newTriangle();
  void kill(TriId t);
  void noteCorners(TriId t);
  void forgetCorners(TriId t);
  struct Unnoted {};  // the triangles of vertices are still to be noted
  EditMesh(TriMesh&& mesh, Unnoted);
  void numberVertices(std::vector<VertexId>& number, bool along_curve);
  void moveTriangles(const std::vector<TriId>& slot, std::size_t count);
  TriMesh released();
  void flipStack(std::vector<TriId>& touched);
  void collectConflicts(const Point& x, std::span<const EdgeRef> across, Patch& cavity) const;
  bool appendSide(EdgeRef side, const Point& x, Patch& cavity) const;
  void fillFan(VertexId x, const Patch& cavity, std::vector<TriId>& fan);

  BulkList<Point> points_;
  std::vector<VertexKind> kinds_;
  std::vector<TriId> triangle_of_;              // one triangle around each vertex
  std::vector<std::uint32_t> triangles_round_;  // number of triangles of each vertex
  std::vector<TriId> free_triangles_;
  std::vector<VertexId> free_vertices_;
  VertexId input_vertices_ = 0;

  // Scratch.
  mutable std::vector<EdgeRef> stack_;
  std::vector<TriId> fan_[2];
  Patch side_[2];
};

namespace detail {

// The index of a chain's point whose circle through the ends contains no other; 0 if all are behind the edge between
// these.
std::size_t delaunayApex(const EditMesh& mesh, std::span<const VertexId> chain);

// Triangulates a chain that is closed by the edge from its last point to its first.
template <typename Accept>
bool triangulateChain(const EditMesh& mesh, std::span<const VertexId> chain, std::vector<Corners>& triangles,
                      const Accept& accept) {
  if (chain.size() < 3) return true;
  const std::size_t apex = delaunayApex(mesh, chain);
  if (apex == 0) return false;
  triangles.push_back({chain.front(), chain[apex], chain.back()});
  return accept(triangles.back()) && triangulateChain(mesh, chain.subspan(0, apex + 1), triangles, accept) &&
         triangulateChain(mesh, chain.subspan(apex), triangles, accept);
}

}  // namespace detail

// The Delaunay triangulation of a simple polygon, given counter-clockwise: k - 2 triangles. Returns false if it has
// none without an inverted triangle, or as soon as `accept` rejects a triangle.
template <typename Accept>
bool triangulatePolygon(const EditMesh& mesh, std::span<const VertexId> polygon, std::vector<Corners>& triangles,
                        const Accept& accept) {
  triangles.clear();
  return detail::triangulateChain(mesh, polygon, triangles, accept);
}

inline bool triangulatePolygon(const EditMesh& mesh, std::span<const VertexId> polygon,
                               std::vector<Corners>& triangles) {
  return triangulatePolygon(mesh, polygon, triangles, [](const Corners&) { return true; });
}

}  // namespace coastmesh
