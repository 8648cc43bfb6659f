#pragma once

#include <cstddef>
#include <span>

#include "core/pslg.hpp"

namespace coastmesh {

// The same input meshed by CGAL, for comparison.

struct Mesh2Result {
  std::size_t vertices = 0;
  std::size_t triangles = 0;   // in the domain
  double triangulate_s = 0.0;  // processor time
  double refine_s = 0.0;
};

// CGAL's Mesh_2 (Ruppert's algorithm) on an unlabelled PSLG, with its hole points as seeds. Its shape criterion bounds
// the squared sine of the smallest angle from below (CGAL's manual: 0.125 stands for 20.7 degrees), hence
// sin²(min_angle_deg).
Mesh2Result runMesh2(const Pslg& pslg, double min_angle_deg);

// A bare Delaunay_triangulation_2 of points, inserted as a range (along a space-filling curve). Returns its count of
// triangles.
std::size_t runBareDelaunay(std::span<const Point> points);

}  // namespace coastmesh
