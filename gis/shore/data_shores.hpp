#pragma once

#include <cstddef>
#include <vector>

#include "core/pslg.hpp"
#include "gis/geometry/box.hpp"

namespace coastmesh {

// The shores of a graph, with the water to their left, to be measured when much of them has been removed.
class DataShores {
 public:
  // REQUIRES: a labelled graph.
  explicit DataShores(const Pslg& pslg);

  // For each of these points: a vertex of the shores there, or kNone.
  std::vector<VertexId> find(const std::vector<Point>& points) const;

  // The shore from a vertex to the point `to`. Empty if it leaves the box or ends before.
  std::vector<Point> piece(VertexId from, const Point& to, const Box& within) const;

  // Islands across lines of two points, as closed rings: for each line, their numbers. Rings that are much longer than
  // a line's reach are no islands.
  struct Islands {
    std::vector<std::vector<Point>> rings;
    std::vector<std::vector<std::size_t>> across;
  };
  struct Across {
    Point a, b;
    double reach = 0.0;
  };
  Islands islandsAcross(const std::vector<Across>& lines) const;

 private:
  std::vector<Point> ringFrom(VertexId v, const Box& within, VertexId& first) const;

  std::vector<Point> at_;
  std::vector<VertexId> next_;  // kNone: on no shore, or where the graph touches itself
};

// The least distance between two pieces of shore that do not cross, across the water to their left. Infinite if they do
// not face each other.
struct ShoreGap {
  double width = 0.0;
  Point middle;
};

// REQUIRES: at least two points each.
ShoreGap gapBetween(const std::vector<Point>& a, const std::vector<Point>& b);

}  // namespace coastmesh
