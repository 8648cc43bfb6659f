#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/pslg.hpp"
#include "gis/geometry/box_tree.hpp"

namespace coastmesh {

// Finds the edge straight below a place, among edges that do not cross.
class EdgesBelow {
 public:
  // REQUIRES: the arguments outlive the search, which keeps references.
  EdgesBelow(const std::vector<Point>& points, const std::vector<std::pair<VertexId, VertexId>>& edges);

  // The highest edge that is not above the place, and whose range of x, without its east end, includes that of the
  // place; kNone if there is none. Vertical edges are never found: those next to them are. Exact.
  std::uint32_t at(const Point& place) const;
  // True if the edge's first end is its west end.
  bool runsEast(std::uint32_t edge) const { return westToEast(edge).first == edges_[edge].first; }

 private:
  std::pair<VertexId, VertexId> westToEast(std::uint32_t edge) const;
  bool isHigher(std::uint32_t f, std::uint32_t e) const;

  const std::vector<Point>& points_;
  const std::vector<std::pair<VertexId, VertexId>>& edges_;
  BoxTree tree_;
};

}  // namespace coastmesh
