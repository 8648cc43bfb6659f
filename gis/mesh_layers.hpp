#pragma once

#include <array>
#include <string_view>

namespace coastmesh {

// Layers of GIS files with a mesh.
inline constexpr std::string_view kTriangleLayer = "triangles", kNodeLayer = "nodes", kBoundaryLayer = "boundaries",
                                  kLineLayer = "lines";

// Columns of the triangles' layer: the ids of a triangle's nodes, counter-clockwise. Polygons do not determine which of
// several nodes at a place is meant, nor the winding, since shapefiles reverse it.
inline constexpr std::array<std::string_view, 3> kCornerColumns = {"node1", "node2", "node3"};
inline constexpr std::string_view kQuadColumn = "quad";

}  // namespace coastmesh
