#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "core/input_corners.hpp"
#include "core/item_loop.hpp"
#include "core/space_point.hpp"
#include "core/surface.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// The three angles of abc in degrees, at a, b and c. REQUIRES: corners are distinct.
std::array<double, 3> anglesDeg(const Point& a, const Point& b, const Point& c);

// The smallest of them.
double leastAngleDeg(const Point& a, const Point& b, const Point& c);

// The same for the flat triangle between points in space, or on the sphere that a plane represents. Points may
// coincide: the angles are then 0°, 0° and 180°.
std::array<double, 3> spaceAnglesDeg(const SpacePoint& a, const SpacePoint& b, const SpacePoint& c);
double leastSpaceAngleDeg(const SpacePoint& a, const SpacePoint& b, const SpacePoint& c);
std::array<double, 3> surfaceAnglesDeg(const Point& a, const Point& b, const Point& c, const Surface& surface);

double signedArea(const Point& a, const Point& b, const Point& c);

struct MeshQuality {
  std::uint64_t vertices = 0;  // used by a triangle
  std::uint64_t triangles = 0;
  double area = 0.0;  // plane units squared, or those of space; sum of flat triangles
  double min_angle_deg = 180.0;
  double max_angle_deg = 0.0;
  double shortest_edge = std::numeric_limits<double>::infinity();  // plane units, or those of space
  double longest_edge = 0.0;
  BoundCounts bounds;  // triangles with an angle below `min_angle_deg` or above `max_angle_deg`
  std::array<std::uint64_t, 36> angle_histogram{};  // all angles of all triangles, in classes of five degrees

  void add(const MeshQuality& other);
};

// Measures the flat triangles between `places`, one for each point of the mesh, if given; otherwise those of the plane.
// Input angles are found in the mesh itself: see InputCorners.
MeshQuality measureQuality(const TriMesh& mesh, double min_angle_deg, double max_angle_deg = 180.0,
                           const ItemLoop& loop = inOrder, std::span<const SpacePoint> places = {});

}  // namespace coastmesh
