#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/point.hpp"
#include "gis/crs/crs.hpp"

namespace coastmesh {

// Orients triangles that a file gives without winding; their first corner stays first. Triangles that share an edge are
// oriented alike, which needs no coordinates and so works for slivers and across half the globe. A connected part
// follows those of its triangles that are correctly `wound`; one without any is turned so that most of it is
// counter-clockwise on the ground. REQUIRES: one flag for each triangle.
void windTriangles(std::span<const Point> nodes, const Crs& crs, const std::vector<bool>& wound,
                   std::span<std::array<std::uint32_t, 3>> triangles);

}  // namespace coastmesh
