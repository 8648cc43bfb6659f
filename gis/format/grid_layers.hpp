#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "gis/grid/grid.hpp"
#include "gis/grid/grid_parts.hpp"
#include "gis/mesh_layers.hpp"

namespace coastmesh {

// The contents of a grid's GIS layers, for any file format. Columns and shapes refer to the grid they were made from.

// Values that are in the grid's arrays are read from there, without a call for each.
struct LayerColumn {
  using Flag = std::function<bool(std::size_t row)>;
  class Whole {
   public:
    // Numbers of the rows, from 1.
    Whole() = default;
    // Ids of a corner of the triangles. REQUIRES: they outlive it.
    Whole(std::span<const std::array<std::uint32_t, 3>> triangles, unsigned corner)
        : triangles_(triangles), corner_(corner) {}
    explicit Whole(std::function<std::int64_t(std::size_t row)> value,
                   std::function<bool(std::size_t row)> is_null = {})
        : value_(std::move(value)), is_null_(std::move(is_null)) {}

    bool isNull(std::size_t row) const { return is_null_ && is_null_(row); }
    // REQUIRES: not null.
    std::int64_t operator()(std::size_t row) const {
      if (!triangles_.empty()) return std::int64_t{triangles_[row][corner_]} + 1;
      return value_ ? value_(row) : static_cast<std::int64_t>(row) + 1;
    }

   private:
    std::span<const std::array<std::uint32_t, 3>> triangles_;
    unsigned corner_ = 0;
    std::function<std::int64_t(std::size_t row)> value_;
    std::function<bool(std::size_t row)> is_null_;
  };
  class Real {
   public:
    // REQUIRES: `values` outlive it.
    explicit Real(std::span<const double> values) : values_(values) {}
    explicit Real(std::vector<double>&& own)
        : own_(std::make_shared<const std::vector<double>>(std::move(own))), values_(*own_) {}

    double operator()(std::size_t row) const { return values_[row]; }

   private:
    std::shared_ptr<const std::vector<double>> own_;
    std::span<const double> values_;
  };
  using Text = std::function<std::string_view(std::size_t row)>;  // empty is null

  std::string name;  // at most ten characters, for the .dbf of a shapefile
  std::variant<Flag, Whole, Real, Text> value;
  std::size_t longest = 0;  // bytes, of a text
};

struct GridLayer {
  enum class Shape { Polygon, Point, Line };

  std::string name;
  Shape shape = Shape::Point;
  std::size_t rows = 0;
  std::vector<LayerColumn> columns;
  // Stores the nodes of the row's shape in `nodes`; closed shapes repeat their first node.
  std::function<void(std::size_t row, std::vector<std::uint32_t>& nodes)> shapeOf;
};

// The layers in this order: triangles (id, node1, node2, node3, quad, min_angle in degrees, area_m2, src_fid, source,
// name, region), nodes (id, z, size), boundaries (id, role, ibtype, closed, length_m) and, if there are any, lines (id,
// kind, name, closed, length_m), ids from 1. Columns without values in the grid are left out; the halves of a
// quadrilateral have its number in `quad`; a triangle's `name` is the first attribute of its feature that is called so,
// or else contains "name". REQUIRES: `grid` outlives the result.
std::vector<GridLayer> layersOf(const Grid& grid, const ItemLoop& loop = inOrder);

// The parts of a grid that layers hold.
inline constexpr GridParts kLayerParts{
    GridPart::Quads,         GridPart::Sizes,       GridPart::Features,  GridPart::FeatureNames, GridPart::Regions,
    GridPart::Lines,         GridPart::LineNames,   GridPart::Rivers,    GridPart::Ibtypes,      GridPart::BareWeirs,
    GridPart::BoundaryNames, GridPart::PartIslands, GridPart::NodeFields};

// The file of a layer in formats with one layer per file: "lake.shp" goes with "lake_nodes.shp", "lake_boundaries.shp"
// and "lake_lines.shp".
std::string pathOfLayer(const std::string& path, std::string_view layer);

}  // namespace coastmesh
