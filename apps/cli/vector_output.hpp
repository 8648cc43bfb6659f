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
  std::vector<Point> points;  // one for a layer of points, two or more for one of lines, a ring not closed for polygons
  std::vector<VectorValue> values;          // one a field of the layer, of the field's type
  std::vector<std::vector<Point>> holes{};  // of a polygon
};

struct VectorLayer {
  enum class Kind { Points, Lines, Polygons, Table };  // a table has no shapes
  std::string name;
  Kind kind = Kind::Points;
  std::vector<std::pair<std::string, VectorValue>> fields;  // name, and a value that has the type
  std::vector<VectorShape> shapes;
};

// Throws OutputError where `path` has none of the endings that hold `layers` layers: .gpkg any number, .geojson and
// .fgb one.
void requireVectorFormat(const std::string& path, std::size_t layers);

// Writes a new file. Throws OutputError.
void writeVectorLayers(const std::string& path, const Crs& crs, const std::vector<VectorLayer>& layers);

}  // namespace coastmesh
