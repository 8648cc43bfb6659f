#pragma once

#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "core/point.hpp"
#include "core/surface.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// A constrained Delaunay triangulation built by inserting points and segments. The outside of the convex hull is filled
// with ghost triangles, whose third corner is numbered after all points, so that every edge has two sides. If all
// points are on one line there is no triangulation.
class DelaunayBuilder {
 public:
  // Thrown if a point or segment meets another that it must not touch.
  struct Clash : std::runtime_error {
    enum class Kind { PointsCoincide, PointOnSegment, SegmentsCross, SegmentsCoincide };
    Clash(Kind k, VertexId v, SegmentId s)
        : std::runtime_error("no planar straight-line graph"), kind(k), at(v), other(s) {}
    Kind kind;
    VertexId at;      // the vertex that was met
    SegmentId other;  // the segment that was met
  };

  // Inserts all points: in rounds, each along Hilbert's curve, so that each point is near the previous one and no input
  // order creates many temporary triangles. Throws Clash if two points coincide.
  explicit DelaunayBuilder(std::span<const Point> points, const Surface& surface = {});

  bool hasTriangles() const { return !mesh_.triangles.empty(); }
  std::span<const VertexId> alongCurve() const { return along_curve_; }  // the points in Hilbert's order

  // Makes the edge from a to b, if it does not exist, and marks it as part of a segment. Throws Clash.
  void insertSegment(VertexId a, VertexId b, SegmentId seg);

  // Including ghosts; all linked.
  std::span<const Triangle> triangles() const { return mesh_.triangles; }
  bool isGhost(TriId t) const {
    const auto& v = mesh_.triangles[t].v;
    return v[0] == ghost_ || v[1] == ghost_ || v[2] == ghost_;
  }
  // A triangle that contains x, a ghost if x is outside the convex hull. The search starts at `near`.
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
  std::vector<VertexId> along_curve_;
  VertexId ghost_;
  LinkedTriangles mesh_;
  std::vector<TriId> triangle_of_;  // one triangle around each vertex

  // Scratch.
  struct CavityEdge {
    VertexId a, b;
    EdgeRef beyond;
  };
  std::vector<EdgeRef> stack_;
  std::vector<TriId> cavity_;
  std::vector<CavityEdge> cavity_edges_;
  // One side of the cavity of a new segment, from its first end to its last. Edge k ends at corner k + 1; edges beyond
  // those are interior ones.
  static constexpr std::size_t kNoPartner = ~std::size_t{0};
  struct SideEdge {
    EdgeRef inside, beyond;
    SegmentId seg;
    std::size_t partner;  // the same edge from its other side, if both are inside
  };
  struct Side {
    std::vector<VertexId> corners;
    std::vector<SideEdge> edges;
  };
  struct Scanned {
    VertexId v;
    std::size_t edge;  // the edge from the previous corner to this one
  };
  Side sides_[2];  // left, right
  std::vector<Scanned> scan_;
  std::size_t filled_ = 0;  // triangles of cavity_ that are reused
};

}  // namespace coastmesh
