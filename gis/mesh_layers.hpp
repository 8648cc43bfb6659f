#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace coastmesh {

// Layers of GIS files with a mesh.
inline constexpr std::string_view kTriangleLayer = "triangles", kNodeLayer = "nodes", kBoundaryLayer = "boundaries",
                                  kLineLayer = "lines";

// What `check` found in one.
inline constexpr std::string_view kDefectLayer = "defects";

// True for all layers of the GeoPackages that this program writes, also those of plane graphs
// (gis/read/cleaned_layers.hpp), and for the styles that QGIS saves beside them.
constexpr bool isOwnLayer(std::string_view name) {
  constexpr std::array<std::string_view, 12> kOwn = {kTriangleLayer, kNodeLayer,   kBoundaryLayer, kLineLayer,
                                                     kDefectLayer,   "pslg",       "edits",        "vertices",
                                                     "features",     "attributes", "regions",      "layer_styles"};
  return std::ranges::find(kOwn, name) != kOwn.end();
}

// Columns of the triangles' layer: the ids of a triangle's nodes, counter-clockwise. Polygons do not determine which of
// several nodes at a place is meant, nor the winding, since shapefiles reverse it.
inline constexpr std::array<std::string_view, 3> kCornerColumns = {"node1", "node2", "node3"};
inline constexpr std::string_view kQuadColumn = "quad";

}  // namespace coastmesh
