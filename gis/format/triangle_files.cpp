#include <ogr_geometry.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <unordered_map>

#include "gis/crs/ogr_support.hpp"
#include "gis/error.hpp"
#include "gis/file/prj_file.hpp"
#include "gis/file/text_reader.hpp"
#include "gis/file/text_writer.hpp"
#include "gis/format/grid_formats.hpp"
#include "gis/grid/boundary_kinds.hpp"
#include "gis/grid/loop_role.hpp"
#include "gis/grid/marked_edges.hpp"

namespace coastmesh {
namespace {

constexpr char kComment = '#';

IdMap readNodes(const std::string& path, Grid& grid) {
  TextReader file(path, kComment);
  file.needLine();
  const std::uint64_t count = file.count();
  if (file.count() != 2) file.fail("the nodes are not in two dimensions");
  const std::uint64_t attributes = file.hasWord() ? file.count() : 0;
  std::vector<std::int64_t> ids;
  for (std::uint64_t i = 0; i < count; ++i) {
    file.needLine();
    ids.push_back(file.integer());
    const double x = file.number(), y = file.number();
    grid.nodes.push_back({x, y});
    if (attributes == 1) grid.z.push_back(file.number());
  }
  return IdMap(std::move(ids), file, "node");
}

// Features by the triangles' attribute, ascending; none unless all values are integers up to 2^53.
void readFeatures(const std::vector<double>& attribute, Grid& grid) {
  constexpr double kExact = 9007199254740992.0;  // 2^53
  const auto isWhole = [](double value) { return value == std::floor(value) && std::abs(value) <= kExact; };
  if (attribute.empty() || !std::ranges::all_of(attribute, isWhole)) return;
  std::vector<double> known = attribute;
  std::ranges::sort(known);
  const auto repeated = std::ranges::unique(known);
  known.erase(repeated.begin(), repeated.end());
  for (const double fid : known) grid.features.push_back({static_cast<std::int64_t>(fid), {}, {}});
  for (const double fid : attribute)
    grid.feature_of.push_back(static_cast<std::uint32_t>(std::ranges::lower_bound(known, fid) - known.begin()));
}

void readElements(const std::string& path, const IdMap& node_index, Grid& grid) {
  TextReader file(path, kComment);
  file.needLine();
  const std::uint64_t count = file.count();
  if (file.count() != 3) file.fail("only triangles of three nodes can be read");
  const std::uint64_t attributes = file.hasWord() ? file.count() : 0;
  std::vector<double> attribute;
  for (std::uint64_t t = 0; t < count; ++t) {
    file.needLine();
    file.integer();
    auto& triangle = grid.triangles.emplace_back();
    for (std::uint32_t& corner : triangle) {
      const std::int64_t id = file.integer();
      corner = node_index.indexOf(id);
      if (corner == kNone) file.fail("there is no node " + std::to_string(id));
    }
    if (attributes > 0) attribute.push_back(file.number());
  }
  readFeatures(attribute, grid);
}

// Reads segments with the markers of `writeTriangle`; others have no roles and are ignored.
void readSegments(const std::string& path, const IdMap& node_index, Grid& grid) {
  TextReader file(path, kComment);
  file.needLine();
  if (file.count() != 0) return;  // a .poly with its own vertices does not belong to the .node
  file.needLine();
  const std::uint64_t count = file.count();
  if (!file.hasWord() || file.count() == 0) return;
  std::vector<MarkedEdge> edges;
  for (std::uint64_t i = 0; i < count; ++i) {
    file.needLine();
    file.integer();
    MarkedEdge& edge = edges.emplace_back();
    for (std::uint32_t& end : edge.nodes) {
      const std::int64_t id = file.integer();
      end = node_index.indexOf(id);
      if (end == kNone) file.fail("there is no node " + std::to_string(id));
    }
    edge.marker = file.integer();
  }
  takeMarkedEdges(edges, grid);
}

// Reads Triangle's .node and .ele, numbered from 0 or 1, with boundaries and lines from a .poly if its markers are
// ours, and the CRS of a .prj beside them; `path` is the .node or the .ele. A single attribute of the nodes is z; an
// integer as attribute of the triangles is their feature. Throws InputError with file and line.
Grid readTriangle(const std::string& path, const Crs& unsaid) {
  Grid grid;
  const IdMap node_index = readNodes(withEnding(path, ".node"), grid);
  readElements(withEnding(path, ".ele"), node_index, grid);
  const std::string poly = withEnding(path, ".poly");
  if (std::filesystem::exists(poly)) readSegments(poly, node_index, grid);
  grid.crs = readPrjBeside(path, unsaid);
  return grid;
}

void writeNodes(const Grid& grid, const std::vector<MarkedEdge>& edges, const std::string& path, const ItemLoop& loop) {
  std::vector<std::int64_t> markers(grid.nodes.size(), 0);
  for (auto edge = edges.rbegin(); edge != edges.rend(); ++edge)
    for (const std::uint32_t node : edge->nodes) markers[node] = edge->marker;
  TextWriter file(path);
  file << grid.nodes.size() << " 2 " << (grid.z.empty() ? 0 : 1) << " 1\n";
  file.rows(loop, grid.nodes.size(), [&](TextBlock& text, std::size_t i) {
    text << i + 1 << ' ' << grid.nodes[i].x << ' ' << grid.nodes[i].y;
    if (!grid.z.empty()) text << ' ' << grid.z[i];
    text << ' ' << markers[i] << '\n';
  });
  file.close();
}

void writeElements(const Grid& grid, const std::string& path, const ItemLoop& loop) {
  TextWriter file(path);
  file << grid.triangles.size() << " 3 " << (grid.feature_of.empty() ? 0 : 1) << '\n';
  file.rows(loop, grid.triangles.size(), [&](TextBlock& text, std::size_t t) {
    const auto& [a, b, c] = grid.triangles[t];
    text << t + 1 << ' ' << a + 1 << ' ' << b + 1 << ' ' << c + 1;
    if (!grid.feature_of.empty()) text << ' ' << grid.features[grid.feature_of[t]].fid;
    text << '\n';
  });
  file.close();
}

using Loop = std::vector<std::uint32_t>;

// Cuts a loop where it passes a node again, so that no loop touches itself.
std::vector<Loop> simpleLoops(const Loop& loop) {
  std::vector<Loop> simple;
  Loop way;
  std::unordered_map<std::uint32_t, std::size_t> place_of;  // in `way`
  for (const std::uint32_t node : loop) {
    if (const auto before = place_of.find(node); before != place_of.end()) {
      const auto first = way.begin() + static_cast<std::ptrdiff_t>(before->second);
      simple.emplace_back(first, way.end());
      for (auto left = first; left != way.end(); ++left)
        if (*left != node) place_of.erase(*left);
      way.erase(first, way.end());
    }
    place_of[node] = way.size();
    way.push_back(node);
  }
  simple.push_back(std::move(way));
  return simple;
}

// False for both sides of a crack.
bool hasArea(const Grid& grid, const Loop& loop) {
  const Point& origin = grid.nodes[loop.front()];
  double twice = 0.0;
  for (std::size_t i = 2; i < loop.size(); ++i) {
    const Point &a = grid.nodes[loop[i - 1]], &b = grid.nodes[loop[i]];
    twice += (a.x - origin.x) * (b.y - origin.y) - (b.x - origin.x) * (a.y - origin.y);
  }
  return twice != 0.0;
}

// Loops around what the mesh leaves out within it, whatever the roles of their boundaries.
std::vector<Loop> loopsOfHoles(const Grid& grid, const ItemLoop& loop) {
  std::vector<Loop> holes;
  for (const Loop& boundary : boundaryLoops(grid, loop))
    for (Loop& part : simpleLoops(boundary))
      if (hasArea(grid, part) && roleOfLoop(grid.nodes, part, grid.crs) == BoundaryRole::Island)
        holes.push_back(std::move(part));
  return holes;
}

Point pointInside(const Grid& grid, const Loop& hole, const std::string& path) {
  const OgrErrors errors;
  OGRLinearRing ring;
  for (std::uint32_t node : hole) ring.addPoint(grid.nodes[node].x, grid.nodes[node].y);
  ring.closeRings();
  OGRPolygon polygon;
  polygon.addRing(&ring);
  OGRPoint inside(0.0, 0.0);  // GDAL does not fill an empty point
  if (polygon.PointOnSurface(&inside) != OGRERR_NONE)
    throw OutputError("cannot write '" + path + "': no point found inside the island at " +
                      std::to_string(grid.nodes[hole[0]].x) + ", " + std::to_string(grid.nodes[hole[0]].y) + " (" +
                      errors.text() + ")");
  return {inside.getX(), inside.getY()};
}

void writeSegments(const Grid& grid, const std::vector<MarkedEdge>& edges, const std::string& path,
                   const ItemLoop& loop) {
  TextWriter file(path);
  file << "0 2 0 1\n" << edges.size() << " 1\n";
  file.rows(loop, edges.size(), [&](TextBlock& text, std::size_t i) {
    const auto& [nodes, marker] = edges[i];
    text << i + 1 << ' ' << nodes[0] + 1 << ' ' << nodes[1] + 1 << ' ' << marker << '\n';
  });
  const std::vector<Loop> loops = loopsOfHoles(grid, loop);
  std::vector<Point> holes(loops.size());
  constexpr std::size_t kIslandsAStretch = 64;
  forStretches(
      loop, loops.size(),
      [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) holes[i] = pointInside(grid, loops[i], path);
      },
      kIslandsAStretch);
  file << holes.size() << '\n';
  for (std::size_t i = 0; i < holes.size(); ++i) file << i + 1 << ' ' << holes[i].x << ' ' << holes[i].y << '\n';
  file.close();
}

// Writes Triangle's .node and .ele, numbered from 1, with boundaries and lines as segments in a .poly and the CRS in a
// .prj; `path` is the .node or the .ele. z is the attribute of a node, the feature's fid that of a triangle. Segments
// are marked with `boundaryMarker` and `lineMarker`, nodes with the marker of the first segment they lie on. Islands
// have a hole point. Throws OutputError.
void writeTriangle(const Grid& grid, const std::string& path, const ItemLoop& loop) {
  requireZ(grid, path);
  const std::vector<MarkedEdge> edges = markedEdges(grid);
  writeNodes(grid, edges, withEnding(path, ".node"), loop);
  writeElements(grid, withEnding(path, ".ele"), loop);
  writeSegments(grid, edges, withEnding(path, ".poly"), loop);
  writePrjBeside(path, grid.crs);
}

}  // namespace

FormatRecord triangleFormat() {
  const auto files = [](const std::string& path) -> OutputFiles {
    return {{withEnding(path, ".node"), withEnding(path, ".ele"), withEnding(path, ".poly")}, {}, prjBeside(path)};
  };
  return {{.name = "triangle",
           .endings = {".node", ".ele"},
           .description = "Triangle's .node, .ele and .poly",
           .readable = true,
           .writable = true,
           .holds = {GridPart::Features, GridPart::Lines, GridPart::Rivers},
           .needs_depths = true,
           .places = NodePlaces::OneTurn},
          {writeTriangle, readTriangle, files}};
}

}  // namespace coastmesh
