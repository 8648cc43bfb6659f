#include "gis/write_triangle.hpp"

#include <ogr_geometry.h>

#include "gis/boundary_chains.hpp"
#include "gis/error.hpp"
#include "gis/grid_formats.hpp"
#include "gis/grid_lines.hpp"
#include "gis/ogr_support.hpp"
#include "gis/prj_file.hpp"
#include "gis/read_triangle.hpp"
#include "gis/text_writer.hpp"

namespace coastmesh {
namespace {

std::int64_t markerOfLine(const Grid& grid, std::size_t line) {
  return lineMarker(grid.boundaries.size() + line, grid.lines[line].kind);
}

void writeNodes(const Grid& grid, const std::string& path) {
  std::vector<std::int64_t> markers(grid.nodes.size(), 0);
  for (std::size_t i = grid.lines.size(); i-- > 0;)
    for (std::uint32_t node : grid.lines[i].nodes) markers[node] = markerOfLine(grid, i);
  for (std::size_t b = grid.boundaries.size(); b-- > 0;)
    for (std::uint32_t node : grid.boundaries[b].nodes) markers[node] = boundaryMarker(b, grid.boundaries[b].role);
  TextWriter file(path);
  file << grid.nodes.size() << " 2 " << (grid.z.empty() ? 0 : 1) << " 1\n";
  for (std::size_t i = 0; i < grid.nodes.size(); ++i) {
    file << i + 1 << ' ' << grid.nodes[i].x << ' ' << grid.nodes[i].y;
    if (!grid.z.empty()) file << ' ' << grid.z[i];
    file << ' ' << markers[i] << '\n';
  }
  file.close();
}

void writeElements(const Grid& grid, const std::string& path) {
  TextWriter file(path);
  file << grid.triangles.size() << " 3 " << (grid.feature_of.empty() ? 0 : 1) << '\n';
  for (std::size_t t = 0; t < grid.triangles.size(); ++t) {
    const auto& [a, b, c] = grid.triangles[t];
    file << t + 1 << ' ' << a + 1 << ' ' << b + 1 << ' ' << c + 1;
    if (!grid.feature_of.empty()) file << ' ' << grid.features[grid.feature_of[t]].fid;
    file << '\n';
  }
  file.close();
}

Point pointInside(const Grid& grid, const Boundary& island, const std::string& path) {
  const OgrErrors errors;
  OGRLinearRing ring;
  for (std::uint32_t node : island.nodes) ring.addPoint(grid.nodes[node].x, grid.nodes[node].y);
  ring.closeRings();
  OGRPolygon polygon;
  polygon.addRing(&ring);
  OGRPoint inside(0.0, 0.0);  // GDAL refuses to fill an empty one
  if (polygon.PointOnSurface(&inside) != OGRERR_NONE)
    throw OutputError("cannot write '" + path + "': no point found inside the island at " +
                      std::to_string(grid.nodes[island.nodes[0]].x) + ", " +
                      std::to_string(grid.nodes[island.nodes[0]].y) + " (" + errors.text() + ")");
  return {inside.getX(), inside.getY()};
}

void writeSegments(const Grid& grid, const std::string& path) {
  std::size_t segments = 0, islands = 0;
  for (const Boundary& boundary : grid.boundaries) {
    segments += edgesOf(boundary).size();
    islands += boundary.closed && boundary.role == BoundaryRole::Island;
  }
  for (const GridLine& line : grid.lines) segments += edgesOf(line).size();
  TextWriter file(path);
  file << "0 2 0 1\n" << segments << " 1\n";
  std::size_t id = 0;
  for (std::size_t b = 0; b < grid.boundaries.size(); ++b)
    for (const auto& [from, to] : edgesOf(grid.boundaries[b]))
      file << ++id << ' ' << from + 1 << ' ' << to + 1 << ' ' << boundaryMarker(b, grid.boundaries[b].role) << '\n';
  for (std::size_t i = 0; i < grid.lines.size(); ++i)
    for (const auto& [from, to] : edgesOf(grid.lines[i]))
      file << ++id << ' ' << from + 1 << ' ' << to + 1 << ' ' << markerOfLine(grid, i) << '\n';
  file << islands << '\n';
  id = 0;
  for (const Boundary& boundary : grid.boundaries) {
    if (!boundary.closed || boundary.role != BoundaryRole::Island) continue;
    const Point hole = pointInside(grid, boundary, path);
    file << ++id << ' ' << hole.x << ' ' << hole.y << '\n';
  }
  file.close();
}

}  // namespace

void writeTriangle(const Grid& grid, const std::string& path) {
  requireZ(grid, path);
  writeNodes(grid, withEnding(path, ".node"));
  writeElements(grid, withEnding(path, ".ele"));
  writeSegments(grid, withEnding(path, ".poly"));
  writePrjBeside(path, grid.crs);
}

FormatRecord triangleFormat() {
  const auto files = [](const std::string& path) -> OutputFiles {
    return {{withEnding(path, ".node"), withEnding(path, ".ele"), withEnding(path, ".poly")}, {}, prjBeside(path)};
  };
  return {{"triangle",
           {".node", ".ele"},
           "Triangle's .node, .ele and .poly",
           true,
           true,
           {GridPart::Features, GridPart::Lines, GridPart::Rivers}},
          {writeTriangle, readTriangle, files}};
}

}  // namespace coastmesh
