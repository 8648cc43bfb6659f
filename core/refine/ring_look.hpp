#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "core/edit_mesh.hpp"
#include "core/metric.hpp"
#include "core/refine/feasible_region.hpp"
#include "core/refine/look_edges.hpp"

namespace coastmesh {

// The ring of a free vertex in the frame at it, prepared when first needed and used by all that is tried on the vertex:
// edge k leads to corner k.
class RingLook {
 public:
  // To be called for another vertex, or another ring of it.
  void forget() { has_edges_ = has_boxes_ = false; }

  LookEdges& edges(const EditMesh& mesh, const Frame& frame, const Ring& ring);
  // REQUIRES, of the following: the edges have been prepared, and the smallest angle is above 0.

  // The box of all petals.
  PetalBox box(const FeasibleRegion& region);
  // Prepares `boxWithout`.
  void prepareBoxes(const FeasibleRegion& region);
  // The box of the ring without the two edges at corner k.
  PetalBox boxWithout(std::size_t k) const;

  // Calls `visit` with the edges not at corner k, while it returns true. Returns whether all were visited.
  template <typename Visit>
  bool visitWithout(std::size_t k, const Visit& visit) const {
    const std::size_t beside = k + 1 < edges_.size() ? k + 1 : 0;
    for (std::size_t i = 0; i < edges_.size(); ++i)
      if (i != k && i != beside && !visit(edges_[i])) return false;
    return true;
  }

 private:
  bool has_edges_ = false, has_boxes_ = false;
  LookEdges edges_;
  std::vector<PetalBox> boxes_;
  std::vector<PetalBox> before_, after_;  // of the edges before edge k; of that and those after it
};

// The triangles between the edges of a link and a place, in pairs. Plane only.
class Fan {
 public:
  // A triangle: scalar products at its corners, for link edge x -> y and the place, and twice its area.
  struct Triangle {
    double at_x, at_y, at_place, area;
  };

  // Measures the triangles, up to the first pair with an angle below the bound: then returns false. A triangle with
  // good angles is so far from flat that the sign of its area is certain.
  bool fit(LookEdges& link, const Point& place, const AngleBound& bound);

  Triangle operator[](std::size_t k) const { return {at_x_[k + 1], at_y_[k + 1], at_place_[k + 1], area_[k + 1]}; }

  // True if every edge from the place to a corner of the link, a loop that it fits, is Delaunay: the two angles
  // opposite it clearly add up to less than a half turn, so that the sum of their cotangents is above 0.
  bool spokesAreDelaunay();

 private:
  std::size_t count_ = 0;
  // Those of triangle k at k + 1. Before them is room for the last one, behind them for one more.
  std::vector<double> at_x_, at_y_, at_place_, area_;
};

}  // namespace coastmesh
