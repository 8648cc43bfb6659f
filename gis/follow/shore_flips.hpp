#pragma once

#include <span>
#include <vector>

#include "gis/follow/shore_triangles.hpp"

namespace coastmesh {

// Edits a triangulation of shores. New and changed triangles are made Delaunay and measured by `finish`. A filled hole
// has a single region.
class ShoreFlips {
 public:
  ShoreFlips(ShoreTriangles& triangles, const SizeFunction& size) : t_(triangles), size_(size) {}

  // An edge of a hole, from `from` to the next edge's `from`, with the hole to its left.
  struct Side {
    VertexId from;
    EdgeRef beyond;  // the same edge from outside
    SegmentId segment;
  };

  // Marks a triangle as changed.
  void touch(TriId t);
  TriId make(const std::array<VertexId, 3>& corners, RegionId region);

  // Removes a vertex that no segment ends in.
  void remove(VertexId v);

  // Inserts a point, already numbered v, in the triangle or on an edge of it that is not a segment.
  void insert(VertexId v, TriId in);

  // Makes the triangulation Delaunay, measures what has changed, renumbers triangles without gaps, sets `region_was`.
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
