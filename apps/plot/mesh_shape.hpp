#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/tri_mesh.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// Valence of each vertex; 0 for those on the boundary, where no valence is best, and for unused ones.
std::vector<std::uint32_t> degreesInside(const TriMesh& mesh);

// The part of each triangle, numbered from 0. Parts are connected by edges and are in one region.
std::vector<std::uint32_t> partsOf(const TriMesh& mesh);

// 4 sqrt(3) area / sum of squared edges: 1 for an equilateral triangle, 0 for a flat one.
double shapeQuality(const Point& a, const Point& b, const Point& c);

// The angles of quadrilaterals, by triangle of the grid: both halves have those of the whole.
struct QuadAngles {
  std::vector<double> least_deg, greatest_deg;  // NaN for a triangle that is no half; empty without quadrilaterals

  bool has(std::size_t triangle) const { return !least_deg.empty() && least_deg[triangle] == least_deg[triangle]; }
  // The smallest sine of the four angles, known as the scaled Jacobian: 1 for a rectangle, 0 if one is 180 degrees or
  // more. REQUIRES: has(triangle).
  double quality(std::size_t triangle) const;
};
QuadAngles quadAnglesOf(const Grid& grid);

}  // namespace coastmesh
