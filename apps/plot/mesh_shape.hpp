#pragma once

#include <cstdint>
#include <vector>

#include "core/tri_mesh.hpp"

namespace coastmesh {

// Valence of each vertex; 0 for those on the boundary, where no valence is best, and for unused ones.
std::vector<std::uint32_t> degreesInside(const TriMesh& mesh);

// The part of each triangle, numbered from 0. Parts are connected by edges and are in one region.
std::vector<std::uint32_t> partsOf(const TriMesh& mesh);

// 4 sqrt(3) area / sum of squared edges: 1 for an equilateral triangle, 0 for a flat one.
double shapeQuality(const Point& a, const Point& b, const Point& c);

}  // namespace coastmesh
