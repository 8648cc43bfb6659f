#pragma once

#include <cstdint>
#include <vector>

#include "core/tri_mesh.hpp"

namespace coastmesh {

// How many neighbours each vertex has; 0 for those on the boundary, where there is no best number, and for unused ones.
std::vector<std::uint32_t> degreesInside(const TriMesh& mesh);

// The number of each triangle's part, from 0: those that hang together by edges and lie in one region.
std::vector<std::uint32_t> partsOf(const TriMesh& mesh);

// 4 sqrt(3) area / sum of squared edges: 1 for an equilateral triangle, 0 for a flat one.
double shapeQuality(const Point& a, const Point& b, const Point& c);

}  // namespace coastmesh
