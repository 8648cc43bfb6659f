#include "apps/job/grid_pieces.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "core/bulk_list.hpp"
#include "core/metric.hpp"
#include "core/pslg.hpp"
#include "core/sphere/close_sphere.hpp"
#include "core/union_find.hpp"
#include "gis/coast/coastline.hpp"
#include "gis/elements/quads.hpp"
#include "gis/error.hpp"
#include "gis/grid/grid_lines.hpp"
#include "gis/grid/loop_role.hpp"
#include "gis/places.hpp"
#include "gis/projection/area_outline.hpp"

namespace coastmesh {

namespace {

// Some triangles with the numbers of their own nodes.
struct OwnNumbers {
  std::vector<std::uint32_t> nodes;                  // the grid's, ascending
  BulkList<std::array<std::uint32_t, 3>> triangles;  // corners by their place in `nodes`
};

// By a table of all the grid's nodes. Pieces are often many, so that is for large ones.
OwnNumbers numbersByTable(const Grid& grid, const std::vector<std::uint32_t>& triangles, const ItemLoop& loop) {
  OwnNumbers own;
  std::vector<std::uint32_t> number(grid.nodes.size(), kNone);
  for (const std::uint32_t t : triangles)
    for (const std::uint32_t node : grid.triangles[t]) number[node] = 0;
  for (std::uint32_t node = 0; node < number.size(); ++node) {
    if (number[node] == kNone) continue;
    number[node] = static_cast<std::uint32_t>(own.nodes.size());
    own.nodes.push_back(node);
  }
  resizeUnset(own.triangles, triangles.size());
  forEachByStretches(loop, triangles.size(), [&](std::size_t i) {
    const auto& [a, b, c] = grid.triangles[triangles[i]];
    own.triangles[i] = {number[a], number[b], number[c]};
  });
  return own;
}

OwnNumbers numbersBySearch(const Grid& grid, const std::vector<std::uint32_t>& triangles) {
  OwnNumbers own;
  own.nodes.reserve(3 * triangles.size());
  for (const std::uint32_t t : triangles)
    own.nodes.insert(own.nodes.end(), grid.triangles[t].begin(), grid.triangles[t].end());
  std::ranges::sort(own.nodes);
  own.nodes.erase(std::unique(own.nodes.begin(), own.nodes.end()), own.nodes.end());
  const auto numberOf = [&own](std::uint32_t node) {
    return static_cast<std::uint32_t>(std::ranges::lower_bound(own.nodes, node) - own.nodes.begin());
  };
  for (const std::uint32_t t : triangles) {
    const auto& [a, b, c] = grid.triangles[t];
    own.triangles.push_back({numberOf(a), numberOf(b), numberOf(c)});
  }
  return own;
}

OwnNumbers ownNumbers(const Grid& grid, const std::vector<std::uint32_t>& triangles, const ItemLoop& loop) {
  constexpr std::size_t kWorthTable = 8;  // nodes of the grid for each triangle
  return triangles.size() < grid.nodes.size() / kWorthTable ? numbersBySearch(grid, triangles)
                                                            : numbersByTable(grid, triangles, loop);
}

// The piece as a grid of its own, from its `OwnNumbers`.
Grid partOf(const Grid& grid, const std::vector<std::uint32_t>& nodes,
            BulkList<std::array<std::uint32_t, 3>>&& triangles) {
  Grid part;
  part.crs = grid.crs;
  part.nodes.reserve(nodes.size());
  for (const std::uint32_t node : nodes) part.nodes.push_back(grid.nodes[node]);
  part.triangles = std::move(triangles);
  return part;
}

// Borders between features were constraints; which segments they were is unknown.
void markBorders(TriMesh& mesh) {
  constexpr SegmentId kSomeSegment = 0;
  for (TriId t = 0; t < mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef twin = mesh.triangles[t].adj[i];
      if (twin != kNone && mesh.regions[t] != mesh.regions[triOf(twin)]) mesh.triangles[t].seg[i] = kSomeSegment;
    }
  }
}

// Lines within the mesh were constraints too, each a segment of its own.
void markLines(const LineEdges& lines, GridPiece& piece) {
  if (lines.empty()) return;
  for (TriId t = 0; t < piece.mesh.triangles.size(); ++t) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i);
      const SegmentId segment = lines.segmentAt(piece.nodes[piece.mesh.origin(e)], piece.nodes[piece.mesh.target(e)]);
      if (segment != kNone) piece.mesh.triangles[t].seg[i] = segment;
    }
  }
}

// The projection of a mesh without an outer shore, which is around its islands: these alone may lie within a small cap.
Projection fitAroundIslands(const Grid& part, const std::vector<std::vector<VertexId>>& loops, SurfaceKind kind) {
  constexpr std::size_t kMostWithin = 4096;
  std::vector<Ring> rings;
  for (const std::vector<VertexId>& loop : loops) {
    Ring& ring = rings.emplace_back();
    for (const VertexId v : loop) ring.push_back(part.nodes[v]);
  }
  std::vector<Point> within;
  for (std::size_t v = 0; v < part.nodes.size(); v += 1 + part.nodes.size() / kMostWithin)
    within.push_back(part.nodes[v]);
  return fittedWithin(part.crs, std::move(rings), std::move(within), "the mesh", kind);
}

}  // namespace

LineEdges::LineEdges(const Grid& grid) {
  for (std::size_t line = 0; line < grid.lines.size(); ++line)
    for (const auto& [a, b] : edgesOf(grid.lines[line]))
      edges_.emplace_back(NodePair{std::min(a, b), std::max(a, b)}, static_cast<SegmentId>(line + 1));
  std::ranges::sort(edges_);
}

LineEdges LineEdges::andQuads(const Grid& grid) {
  LineEdges all(grid);
  for (const NodePair& edge : edgesOfQuads(grid))
    all.edges_.emplace_back(edge, static_cast<SegmentId>(grid.lines.size() + 1));
  std::ranges::sort(all.edges_);
  return all;
}

SegmentId LineEdges::segmentAt(std::uint32_t a, std::uint32_t b) const {
  const NodePair key{std::min(a, b), std::max(a, b)};
  const auto at = std::ranges::lower_bound(edges_, key, {}, &std::pair<NodePair, SegmentId>::first);
  return at != edges_.end() && at->first == key ? at->second : kNone;
}

std::vector<std::vector<std::uint32_t>> connectedTriangles(const Grid& grid) {
  UnionFind joined(grid.nodes.size());
  for (const auto& corners : grid.triangles)
    for (int i : {1, 2}) joined.unite(corners[0], corners[i]);
  std::vector<std::vector<std::uint32_t>> pieces;
  std::vector<std::uint32_t> piece_of(grid.nodes.size(), kNone);
  for (std::uint32_t t = 0; t < grid.triangles.size(); ++t) {
    std::uint32_t& piece = piece_of[joined.find(grid.triangles[t][0])];
    if (piece == kNone) {
      piece = static_cast<std::uint32_t>(pieces.size());
      pieces.emplace_back();
    }
    pieces[piece].push_back(t);
  }
  return pieces;
}

Projection fitProjection(const Grid& grid, const std::vector<std::uint32_t>& triangles, SurfaceKind kind,
                         const ItemLoop& loop) {
  if (grid.crs.isPlane()) return Projection::plane();
  OwnNumbers own = ownNumbers(grid, triangles, loop);
  Grid part = partOf(grid, own.nodes, std::move(own.triangles));
  std::vector<EdgeConflict> conflicts;
  const TriMesh linked = linkTriangles(part.nodes, part.triangles, conflicts, loop);
  Coastline outline;
  outline.crs = grid.crs;
  outline.features.emplace_back().source = "the mesh";
  const std::vector<std::vector<VertexId>> loops = boundaryLoops(linked, loop);
  const auto isOuter = [&](const std::vector<VertexId>& each) {
    return roleOfLoop(part.nodes, each, grid.crs) == BoundaryRole::Land;
  };
  if (conflicts.empty() && grid.crs.geographic && !loops.empty() && std::ranges::none_of(loops, isOuter))
    return fitAroundIslands(part, loops, kind);
  for (const auto& of_boundary : loops) {
    Polygon& polygon = outline.features[0].polygons.emplace_back();
    for (VertexId v : of_boundary) polygon.outer.push_back(part.nodes[v]);
  }
  if (conflicts.empty() && isClosed(linked)) {
    // What is opposite to this place lies beyond the plane: a point of the first triangle, off its axes of symmetry.
    const auto& [a, b, c] = part.triangles.front();
    outline.features[0].points.push_back(0.5 * part.nodes[a] + 0.3 * part.nodes[b] + 0.2 * part.nodes[c]);
    outline.rest = 0;
    return Projection::fitted(outline, {0}, kind);
  }
  // A broken grid may have no boundary.
  if (outline.features[0].polygons.empty())
    outline.features[0].polygons.push_back({{part.nodes.begin(), part.nodes.end()}, {}});
  return Projection::fitted(outline, {0}, kind);
}

const ItemLoop& loopOfPiece(std::size_t triangles, const ItemLoop& loop) {
  constexpr std::size_t kWorthThreads = 20'000;
  static const ItemLoop in_order = inOrder;
  return triangles < kWorthThreads ? in_order : loop;
}

GridPiece makePiece(const Grid& grid, std::vector<std::uint32_t> triangles, const Projection& projection,
                    const LineEdges& lines, const ItemLoop& loop) {
  GridPiece piece;
  piece.projection = projection;
  OwnNumbers own = ownNumbers(grid, triangles, loop);
  piece.nodes = std::move(own.nodes);
  piece.triangles = std::move(triangles);
  piece.mesh = toTriMesh(partOf(grid, piece.nodes, std::move(own.triangles)), projection, piece.conflicts, loop);
  if (!grid.feature_of.empty()) {
    for (std::size_t t = 0; t < piece.triangles.size(); ++t) {
      piece.mesh.regions[t] = static_cast<RegionId>(grid.feature_of[piece.triangles[t]]);
    }
    markBorders(piece.mesh);
  }
  markLines(lines, piece);
  const Surface surface = projection.surface();
  bool has_antipode = false;
  for (std::size_t i = 0; i < piece.nodes.size(); ++i) {
    Point& place = piece.mesh.points[i];
    if (isInRange(place)) continue;
    // A whole globe has a node opposite to the plane's centre.
    if (surface.isCurved() && !has_antipode) {
      place = antipodeOf(surface);
      has_antipode = true;
      continue;
    }
    throw InputError("the node at " + placeInWords(grid.nodes[piece.nodes[i]]) +
                     " lies beyond every plane that shows the mesh: its triangles overlap, or hold the whole Earth");
  }
  piece.places = projection.groundPlaces(piece.mesh.points, loop).space;
  return piece;
}

std::vector<GridPiece> splitGrid(const Grid& grid, SurfaceKind kind, const ItemLoop& loop) {
  std::vector<GridPiece> pieces;
  const LineEdges lines = LineEdges::andQuads(grid);
  for (std::vector<std::uint32_t>& triangles : connectedTriangles(grid)) {
    const ItemLoop& of_piece = loopOfPiece(triangles.size(), loop);
    const Projection projection = fitProjection(grid, triangles, kind, of_piece);
    pieces.push_back(makePiece(grid, std::move(triangles), projection, lines, of_piece));
  }
  return pieces;
}

}  // namespace coastmesh
