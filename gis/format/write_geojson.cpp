#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "gis/error.hpp"
#include "gis/file/text_writer.hpp"
#include "gis/format/grid_formats.hpp"
#include "gis/format/grid_layers.hpp"
#include "gis/format/read_ogr_grid.hpp"
#include "gis/grid/map_parts.hpp"

namespace coastmesh {
namespace {

// A JSON string; bytes that are not UTF-8 become U+FFFD.
std::string jsonText(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string crsMember(const Crs& crs, const std::string& path) {
  if (crs.isPlane())
    return R"("crs": null,)"
           "\n";
  if (crs.authority == "EPSG:4326" || crs.authority == "OGC:CRS84") return {};
  const std::size_t colon = crs.authority.find(':');
  if (colon == std::string::npos)
    throw OutputError("cannot write '" + path + "': GeoJSON can only name a CRS by its code, and " + nameOf(crs) +
                      " has none; choose .gpkg");
  const std::string urn = "urn:ogc:def:crs:" + crs.authority.substr(0, colon) + "::" + crs.authority.substr(colon + 1);
  return R"("crs": {"type": "name", "properties": {"name": )" + jsonText(urn) + "}},\n";
}

void writeValue(TextBlock& file, const LayerColumn& column, std::size_t row) {
  if (const auto* flag = std::get_if<LayerColumn::Flag>(&column.value)) {
    file << ((*flag)(row) ? "true" : "false");
  } else if (const auto* whole = std::get_if<LayerColumn::Whole>(&column.value)) {
    if (whole->isNull(row))
      file << "null";
    else
      file << (*whole)(row);
  } else if (const auto* real = std::get_if<LayerColumn::Real>(&column.value)) {
    const double value = (*real)(row);
    if (std::isfinite(value))
      file << value;
    else
      file << "null";
  } else {
    const std::string_view text = std::get<LayerColumn::Text>(column.value)(row);
    file << (text.empty() ? "null" : jsonText(text));
  }
}

void writeRing(TextBlock& file, const MapCutter::Ring& ring) {
  file << "[[";
  for (std::size_t i = 0; i <= ring.size(); ++i) {
    const Point& p = ring[i % ring.size()];
    file << (i > 0 ? ",[" : "[") << p.x << ',' << p.y << ']';
  }
  file << "]]";
}

void writeCutTriangle(TextBlock& file, const std::vector<MapCutter::Ring>& parts) {
  if (parts.size() == 1) {
    file << R"({"type":"Polygon","coordinates":)";
    writeRing(file, parts[0]);
  } else {
    file << R"({"type":"MultiPolygon","coordinates":[)";
    for (std::size_t k = 0; k < parts.size(); ++k) {
      if (k > 0) file << ',';
      writeRing(file, parts[k]);
    }
    file << ']';
  }
  file << '}';
}

void writeCutLine(TextBlock& file, const std::vector<std::vector<Point>>& parts) {
  file << (parts.size() == 1 ? R"({"type":"LineString","coordinates":)"
                             : R"({"type":"MultiLineString","coordinates":[)");
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (k > 0) file << ',';
    for (std::size_t i = 0; i < parts[k].size(); ++i)
      file << (i > 0 ? ",[" : "[[") << parts[k][i].x << ',' << parts[k][i].y << ']';
    file << ']';
  }
  file << (parts.size() == 1 ? "}" : "]}");
}

void writeShape(TextBlock& file, const Grid& grid, GridLayer::Shape shape, const std::vector<std::uint32_t>& nodes,
                const MapCutter& cutter) {
  if (shape == GridLayer::Shape::Polygon && cutter.cuts({nodes[0], nodes[1], nodes[2]}))
    return writeCutTriangle(file, cutter.partsOf({nodes[0], nodes[1], nodes[2]}));
  if (shape == GridLayer::Shape::Line && cutter.cutsLine(nodes)) return writeCutLine(file, cutter.partsOfLine(nodes));
  const auto writePlace = [&](std::uint32_t node) {
    file << '[' << grid.nodes[node].x << ',' << grid.nodes[node].y;
    if (shape == GridLayer::Shape::Point && !grid.z.empty() && std::isfinite(grid.z[node])) file << ',' << grid.z[node];
    file << ']';
  };
  const auto writePlaces = [&] {
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (i > 0) file << ',';
      writePlace(nodes[i]);
    }
  };
  switch (shape) {
    case GridLayer::Shape::Point:
      file << R"({"type":"Point","coordinates":)";
      writePlace(nodes[0]);
      break;
    case GridLayer::Shape::Line:
      file << R"({"type":"LineString","coordinates":[)";
      writePlaces();
      file << ']';
      break;
    case GridLayer::Shape::Polygon:
      file << R"({"type":"Polygon","coordinates":[[)";
      writePlaces();
      file << "]]";
      break;
  }
  file << '}';
}

void writeLayer(const Grid& grid, const GridLayer& layer, const std::string& crs_member, const std::string& path,
                const MapCutter& cutter, const ItemLoop& loop) {
  TextWriter file(path);
  file << "{\n\"type\": \"FeatureCollection\",\n\"name\": " << jsonText(layer.name) << ",\n"
       << crs_member << "\"features\": [\n";
  std::vector<std::string> keys;
  keys.reserve(layer.columns.size());
  for (const LayerColumn& column : layer.columns) keys.push_back(jsonText(column.name));
  file.rows(loop, layer.rows, [&](TextBlock& text, std::size_t row) {
    text << R"({"type":"Feature","properties":{)";
    for (std::size_t c = 0; c < layer.columns.size(); ++c) {
      text << (c == 0 ? "" : ",") << keys[c] << ':';
      writeValue(text, layer.columns[c], row);
    }
    text << R"(},"geometry":)";
    std::vector<std::uint32_t> nodes;
    layer.shapeOf(row, nodes);
    writeShape(text, grid, layer.shape, nodes, cutter);
    text << (row + 1 < layer.rows ? "},\n" : "}\n");
  });
  file << "]\n}\n";
  file.close();
}

// Writes the grid's layers as three or four GeoJSON files: triangles to `path`, and beside it nodes, boundaries and any
// lines. OGR is not used here, since not all of its numbers are read back bit for bit, and it writes a CRS that it
// cannot name as WGS 84. WGS 84 is written as in RFC 7946; other CRS in their own coordinates with the `crs` member of
// GeoJSON 2008, null for a plane. Throws OutputError, also for a CRS without a code, since GeoJSON can only name codes.
void writeGeoJson(const Grid& grid, const std::string& path, const ItemLoop& loop) {
  const std::string crs_member = crsMember(grid.crs, path);
  const MapCutter cutter(grid);
  for (const GridLayer& layer : layersOf(grid, loop))
    writeLayer(grid, layer, crs_member, pathOfLayer(path, layer.name), cutter, loop);
}

}  // namespace

FormatRecord geoJsonFormat() {
  return {{.name = "geojson",
           .endings = {".geojson", ".json"},
           .description = "GeoJSON, three or four files",
           .readable = true,
           .writable = true,
           .holds = kLayerParts},
          {writeGeoJson, readOgrGrid, layerFiles}};
}

}  // namespace coastmesh
