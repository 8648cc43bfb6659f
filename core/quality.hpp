#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "core/input_corners.hpp"
#include "core/item_loop.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// The three angles of abc in degrees, at a, b and c. REQUIRES: no two corners equal.
std::array<double, 3> anglesDeg(const Point& a, const Point& b, const Point& c);

double signedArea(const Point& a, const Point& b, const Point& c);

struct MeshQuality {
  std::uint64_t vertices = 0;  // those that a triangle uses
  std::uint64_t triangles = 0;
  double area = 0.0;  // plane units squared
  double min_angle_deg = 180.0;
  double max_angle_deg = 0.0;
  double shortest_edge = std::numeric_limits<double>::infinity();  // plane units
  double longest_edge = 0.0;
  BoundCounts bounds;  // triangles with an angle below `min_angle_deg` or above `max_angle_deg`
  std::array<std::uint64_t, 36> angle_histogram{};  // all angles of all triangles, in classes of five degrees

  void add(const MeshQuality& other);
};

// Input angles are found in the mesh itself: see InputCorners.
MeshQuality measureQuality(const TriMesh& mesh, double min_angle_deg, double max_angle_deg = 180.0,
                           const ItemLoop& loop = inOrder);

}  // namespace coastmesh
