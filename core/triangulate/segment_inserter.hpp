#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/triangulate/triangulation.hpp"

namespace coastmesh {

// Inserts segments between points of a Delaunay triangulation, which becomes a constrained one. REQUIRES: it has
// triangles.
class SegmentInserter {
 public:
  explicit SegmentInserter(Triangulation& triangulation)
      : all_(triangulation), mesh_(all_.mesh), triangles_(all_.mesh.triangles) {}

  // The edge from a to b; kNone if there is none.
  EdgeRef findEdge(VertexId a, VertexId b) const;

  // Marks an edge as part of a segment. Throws Clash.
  void mark(EdgeRef edge, SegmentId seg);

  // Makes the edge from a to b, if it does not exist, and marks it. Throws Clash.
  void insert(VertexId a, VertexId b, SegmentId seg);

 private:
  void openChannel(VertexId a, VertexId b);
  EdgeRef fillSide(unsigned side);
  void attach(EdgeRef inside, unsigned side, std::size_t edge);
  void restoreDelaunay();

  Triangulation& all_;
  const LinkedTriangles& mesh_;
  std::span<Triangle> triangles_;

  // Scratch.
  std::vector<EdgeRef> stack_;
  std::vector<TriId> cavity_;
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
