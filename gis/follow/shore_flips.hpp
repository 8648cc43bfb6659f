#pragma once

#include <span>
#include <vector>

#include "gis/follow/shore_triangles.hpp"

namespace coastmesh {

// Changes of a triangulation of shores. Triangles that are made or changed wait for `finish`. Regions follow: what is
// filled is all of one region.
class ShoreFlips {
 public:
  ShoreFlips(ShoreTriangles& triangles, const SizeFunction& size) : t_(triangles), size_(size) {}

  // An edge of a hole: the hole lies to the left on the way from `from` to the next one's.
  struct Side {
    VertexId from;
    EdgeRef beyond;  // the same edge from outside
    SegmentId segment;
  };

  // Edges of a triangle are to be looked at.
  void touch(TriId t);
  TriId make(const std::array<VertexId, 3>& corners, RegionId region);

  // Takes out a vertex that no segment ends in.
  void remove(VertexId v);

  // Puts a point with a number of its own into the triangle, or on its edge that is no segment.
  void insert(VertexId v, TriId in);

  // Makes all Delaunay, measures what has changed, and closes gaps in the numbers of triangles.
  void finish();

 private:
  void fill(std::vector<Side>& hole, RegionId region);
  std::size_t earOf(const std::vector<Side>& hole) const;
  Side sideOf(EdgeRef inside) const;
  void free(TriId t);
  void pack();

  ShoreTriangles& t_;
  const SizeFunction& size_;
  std::vector<EdgeRef> waiting_;
  std::vector<TriId> changed_, free_;
};

}  // namespace coastmesh
