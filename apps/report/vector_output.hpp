#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "core/point.hpp"
#include "gis/crs/crs.hpp"

namespace coastmesh {

using VectorValue = std::variant<std::int64_t, double, std::string>;

struct VectorShape {
  std::vector<Point> points;        // one for points, two or more for lines, for polygons a ring without repeated point
  std::vector<VectorValue> values;  // one per field of the layer, of the field's type
  std::vector<std::vector<Point>> holes{};  // of a polygon
};

struct VectorLayer {
  enum class Kind { Points, Lines, Polygons, Table };  // a table has no shapes
  std::string name;
  Kind kind = Kind::Points;
  std::vector<std::pair<std::string, VectorValue>> fields;  // name, and a value of the type
  std::vector<VectorShape> shapes;
};

// Throws OutputError unless `path` has an ending whose format holds `layers` layers: .gpkg any number, .geojson and
// .fgb one.
void requireVectorFormat(const std::string& path, std::size_t layers);

// Writes a new file. Throws OutputError.
void writeVectorLayers(const std::string& path, const Crs& crs, const std::vector<VectorLayer>& layers);

}  // namespace coastmesh
