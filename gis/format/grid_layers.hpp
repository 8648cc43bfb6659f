#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "gis/grid/grid.hpp"
#include "gis/grid/grid_parts.hpp"

namespace coastmesh {

// What the GIS layers of a grid hold, whatever file they go to. Columns and shapes refer to the grid they were made of.

struct LayerColumn {
  using Flag = std::function<bool(std::size_t row)>;
  using Whole = std::function<std::optional<std::int64_t>(std::size_t row)>;  // none is null
  using Real = std::function<double(std::size_t row)>;
  using Text = std::function<std::string_view(std::size_t row)>;  // empty is null

  std::string name;  // ten letters at most, for the .dbf of a shapefile
  std::variant<Flag, Whole, Real, Text> value;
  std::size_t longest = 0;  // bytes, of a text
};

struct GridLayer {
  enum class Shape { Polygon, Point, Line };

  std::string name;
  Shape shape = Shape::Point;
  std::size_t rows = 0;
  std::vector<LayerColumn> columns;
  // The nodes of the row's shape in `nodes`; what is closed ends where it starts.
  std::function<void(std::size_t row, std::vector<std::uint32_t>& nodes)> shapeOf;
};

inline constexpr std::string_view kTriangleLayer = "triangles", kNodeLayer = "nodes", kBoundaryLayer = "boundaries",
                                  kLineLayer = "lines";

// Of the triangles' layer: the ids of a triangle's nodes, counter-clockwise. Polygons say neither which of several
// nodes at a place is meant nor, after a Shapefile has turned them, the winding.
inline constexpr std::array<std::string_view, 3> kCornerColumns = {"node1", "node2", "node3"};

// The layers in this order: triangles (id, node1, node2, node3, min_angle in degrees, area_m2, src_fid, source, name,
// region), nodes (id, z, size), boundaries (id, role, ibtype, closed, length_m) and, where there are any, lines (id,
// kind, name, closed, length_m), ids from 1. Columns that the grid has nothing for are left out; `name` is the first
// attribute of the source feature that is called so, or like it. REQUIRES: `grid` outlives the result.
std::vector<GridLayer> layersOf(const Grid& grid);

// What layers hold of a grid.
inline constexpr GridParts kLayerParts{GridPart::Sizes,   GridPart::Features, GridPart::FeatureNames,
                                       GridPart::Regions, GridPart::Lines,    GridPart::LineNames,
                                       GridPart::Rivers,  GridPart::Ibtypes,  GridPart::BareWeirs};

// Files that hold one layer each: "lake.shp" goes with "lake_nodes.shp" and "lake_boundaries.shp" and "lake_lines.shp".
std::string pathOfLayer(const std::string& path, std::string_view layer);

}  // namespace coastmesh
