#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/tri_mesh.hpp"

namespace coastmesh {

enum class VertexKind : std::uint8_t {
  Input,    // never moved, never removed
  Segment,  // lies inside an input segment: slides along it at most
  Free,
};

using Corners = std::array<VertexId, 3>;

// One edge of the boundary of a patch of triangles, the patch to its left.
struct BoundaryEdge {
  VertexId a = kNone;
  VertexId b = kNone;
  EdgeRef beyond = kNone;  // the same edge seen from outside the patch; kNone where there is nothing
  SegmentId seg = kNone;
};

// Some triangles and their boundary. For a patch without holes the boundary is one loop, in order, counter-clockwise.
struct Patch {
  std::vector<TriId> triangles;
  std::vector<BoundaryEdge> boundary;
};

// New numbers by old ones; kNone for what is gone.
struct Renumbering {
  std::vector<VertexId> vertex;
  std::vector<TriId> triangle;
};

// What lies round a vertex: a full turn of triangles, those from boundary to boundary, or more than were asked for.
enum class StarKind { Closed, Open, TooMany };

// What is round a vertex, counter-clockwise: where each edge of its link starts, and the triangle there.
struct Ring {
  std::vector<VertexId> corners;
  std::vector<TriId> triangles;
};

// A triangulation under change: compact arrays with free lists.
// Operations that change it append the triangles they made or changed to `touched`.
class EditMesh : private LinkedTriangles {
 public:
  explicit EditMesh(TriMesh&& mesh);

  // The mesh without dead entries. Input vertices keep their numbers; Steiner points, and triangles with them, are put
  // in an order that keeps neighbours near in memory. Leaves `regions` empty.
  TriMesh release() {
    Renumbering by;
    return release(by, true);
  }
  // The same, and the new numbers; unless `along_curve`, Steiner points stay in the order that they are in.
  TriMesh release(Renumbering& by, bool along_curve);  // the mesh is empty after it

  const Point& point(VertexId v) const { return points_[v]; }
  const Point& corner(TriId t, unsigned i) const { return points_[triangles[t].v[i]]; }
  bool isLive(TriId t) const { return triangles[t].v[0] != kNone; }
  bool isLiveVertex(VertexId v) const { return triangle_of_[v] != kNone; }
  VertexKind kind(VertexId v) const { return kinds_[v]; }
  TriId triangleOf(VertexId v) const { return triangle_of_[v]; }
  // How many triangles have v as a corner.
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

  // Calls `visit` with the edge opposite v in each triangle round it, counter-clockwise from the triangle `home` on:
  // once round, or up to the boundary. Visits no more than `most`.
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

  // The edges opposite v in the triangles round it, counter-clockwise; of an open star from boundary to boundary. At a
  // pinched vertex: the star that holds triangleOf(v). Where there are more than `most` the edges are some of them.
  StarKind star(VertexId v, std::vector<EdgeRef>& opposite,
                std::size_t most = std::numeric_limits<std::size_t>::max()) const;

  // The same as a ring, from the triangle `home` on. REQUIRES: v is not on the boundary.
  StarKind ring(VertexId v, TriId home, std::size_t most, Ring& ring) const;

  // The triangles round the given vertices and their boundary. REQUIRES: the vertices are connected by edges, none is
  // on the boundary of the mesh. Returns false where the patch is not a disk.
  bool gatherPatch(std::span<const VertexId> vertices, Patch& patch) const;

  struct Place {
    TriId triangle = kNone;   // holds the point, where nothing is in the way
    EdgeRef blocked = kNone;  // else the subsegment that is
  };
  // Walks towards x, not across segments or the boundary. Both are kNone where the walk does not end.
  Place locate(const Point& x, TriId from) const;

  // The triangles whose circumcircles hold x, as far as x sees them. REQUIRES: x lies in `start`. The boundary is in
  // order. Returns false where rounding leaves x on or beyond the boundary.
  bool findCavity(const Point& x, TriId start, Patch& cavity) const;

  // Fills a cavity with a fan round a new free vertex.
  VertexId insertInCavity(const Point& x, const Patch& cavity, std::vector<TriId>& touched);

  // The same for x on a subsegment: the triangles on both sides, and their boundary without the subsegment, side by
  // side.
  bool findSplitCavity(EdgeRef edge, const Point& x, Patch& cavity) const;

  // Splits a subsegment with a new vertex at x, on it as well as doubles allow. Returns kNone, and changes nothing,
  // where rounding would turn a triangle over.
  VertexId splitSegment(EdgeRef edge, const Point& x, std::vector<TriId>& touched);

  // Puts other triangles into a patch. `fresh` covers it with the same boundary; edges of `fresh` that `inner` names,
  // either way round, become subsegments. Vertices in `gone` die. Does not restore the Delaunay property.
  void replace(const Patch& patch, std::span<const Corners> fresh, std::span<const VertexId> gone,
               std::vector<TriId>& touched, std::span<const BoundaryEdge> inner = {});

  VertexId addVertex(const Point& x, VertexKind kind);

  // Moves a vertex. REQUIRES: every triangle of its star stays counter-clockwise. Does not restore the Delaunay
  // property.
  void setPoint(VertexId v, const Point& to) { points_[v] = to; }

  // Lawson's flips, from all edges of the triangles in `touched` on; appends the triangles they change.
  void restoreDelaunay(std::vector<TriId>& touched);

  // The same where `touched` is the star of v, which has no boundary.
  void restoreDelaunayRound(VertexId v, std::vector<TriId>& touched);

 private:
  TriId newTriangle();
  void kill(TriId t);
  void noteCorners(TriId t);
  void forgetCorners(TriId t);
  void moveTriangles(const std::vector<TriId>& slot, std::size_t count);
  void flipStack(std::vector<TriId>& touched);
  void collectConflicts(const Point& x, std::span<const EdgeRef> across, Patch& cavity) const;
  bool appendSide(EdgeRef side, const Point& x, Patch& cavity) const;
  void fillFan(VertexId x, const Patch& cavity, std::vector<TriId>& fan);

  std::vector<Point> points_;
  std::vector<VertexKind> kinds_;
  std::vector<TriId> triangle_of_;              // one of the triangles round a vertex
  std::vector<std::uint32_t> triangles_round_;  // one a vertex: how many
  std::vector<TriId> free_triangles_;
  std::vector<VertexId> free_vertices_;
  VertexId input_vertices_ = 0;

  // Scratch.
  mutable std::vector<EdgeRef> stack_;
  std::vector<TriId> fan_[2];
  Patch side_[2];
};

namespace detail {

// The point of a chain, other than its ends, whose circle through the ends holds no other. 0 where all lie behind.
std::size_t delaunayApex(const EditMesh& mesh, std::span<const VertexId> chain);

// Triangulates a chain, closed by the edge from its last point to its first.
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

// The Delaunay triangulation of a simple polygon given counter-clockwise: k - 2 triangles. Returns false where it has
// none without a turned triangle, or as soon as `accept` refuses a triangle.
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
