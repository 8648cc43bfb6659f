#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "core/point.hpp"
#include "core/surface.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// The constrained Delaunay triangulation of points that grows by a point or a segment at a time. What is outside the
// convex hull is triangles too: with a ghost for their third corner, which is numbered after all points. So every edge
// has two sides. Where the points are on one line there is no triangulation.
class DelaunayBuilder {
 public:
  // What a point or a segment meets where it must not.
  struct Clash : std::runtime_error {
    enum class Kind { PointsCoincide, PointOnSegment, SegmentsCross, SegmentsCoincide };
    Clash(Kind k, VertexId v, SegmentId s)
        : std::runtime_error("no planar straight-line graph"), kind(k), at(v), other(s) {}
    Kind kind;
    VertexId at;      // the vertex that is met
    SegmentId other;  // the segment that is met
  };

  // Inserts all points: in rounds, each along Hilbert's curve, so that each point lies near the one before and no order
  // of them makes many triangles for nothing. Throws Clash for points at the same place.
  explicit DelaunayBuilder(std::span<const Point> points, const Surface& surface = {});

  bool hasTriangles() const { return !mesh_.triangles.empty(); }

  // Makes the edge from a to b, if it is not there, and a segment of it. Throws Clash.
  void insertSegment(VertexId a, VertexId b, SegmentId seg);

  // Ghosts included; all linked.
  std::span<const Triangle> triangles() const { return mesh_.triangles; }
  bool isGhost(TriId t) const {
    const auto& v = mesh_.triangles[t].v;
    return v[0] == ghost_ || v[1] == ghost_ || v[2] == ghost_;
  }
  // A triangle that holds x, a ghost where x is outside the convex hull. Looks from `near` on.
  TriId locate(const Point& x, TriId near) const;

 private:
  bool startWith(std::vector<VertexId>& order);
  void insertPoint(VertexId x);
  TriId walkTo(const Point& x, TriId from) const;
  bool isInConflict(TriId t, const Point& x) const;
  TriId makeTriangle(VertexId a, VertexId b, VertexId c);
  EdgeRef findEdge(VertexId a, VertexId b) const;
  void openChannel(VertexId a, VertexId b);
  EdgeRef fillSide(unsigned side);
  void attach(EdgeRef inside, unsigned side, std::size_t edge);
  void restoreDelaunay();

  std::span<const Point> points_;
  VertexId ghost_;
  LinkedTriangles mesh_;
  std::vector<TriId> triangle_of_;  // one of the triangles round a vertex

  // Scratch.
  struct CavityEdge {
    VertexId a, b;
    EdgeRef beyond;
  };
  std::vector<EdgeRef> stack_;
  std::vector<TriId> cavity_;
  std::vector<CavityEdge> cavity_edges_;
  // One side of what a new segment goes through, from its first end to its last. Edge k ends at corner k + 1; further
  // edges are inner ones.
  static constexpr std::size_t kNoPartner = ~std::size_t{0};
  struct SideEdge {
    EdgeRef inside, beyond;
    SegmentId seg;
    std::size_t partner;  // the same edge from its other side, where both are inside
  };
  struct Side {
    std::vector<VertexId> corners;
    std::vector<SideEdge> edges;
  };
  struct Scanned {
    VertexId v;
    std::size_t edge;  // that leads here from the one before
  };
  Side sides_[2];  // left, right
  std::vector<Scanned> scan_;
  std::size_t filled_ = 0;  // triangles of cavity_ that are in use again
};

}  // namespace coastmesh
