#include "apps/job/check_grid.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <span>
#include <unordered_map>
#include <utility>

#include "apps/job/grid_pieces.hpp"
#include "core/point_hash.hpp"
#include "core/quality.hpp"
#include "core/sphere/close_sphere.hpp"
#include "gis/crs/geodesy.hpp"
#include "gis/elements/quads.hpp"
#include "gis/error.hpp"
#include "gis/grid/frame_box.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/grid/ground_orientation.hpp"
#include "gis/grid/local_plane.hpp"

namespace coastmesh {

namespace {

struct InputVertex {
  std::size_t group = 0;
  VertexId vertex = 0;
};
using InputVertices = std::unordered_map<Point, InputVertex, PointHash>;

// Adds each place a turn to the east and to the west if the grid has longitudes beyond those of the input: in files of
// models they continue past 180°.
void addTurns(const Grid& grid, InputVertices& vertices) {
  if (!grid.crs.geographic || grid.nodes.empty() || vertices.empty()) return;
  const auto longitude = [](const auto& known) { return known.first.x; };
  const auto [west, east] = std::ranges::minmax_element(vertices, {}, longitude);
  const auto [least, greatest] = std::ranges::minmax(grid.nodes, {}, &Point::x);
  if (least.x >= west->first.x && greatest.x <= east->first.x) return;
  const std::vector<std::pair<Point, InputVertex>> known(vertices.begin(), vertices.end());
  for (const auto& [place, vertex] : known)
    for (const double turn : {360.0, -360.0}) vertices.emplace(Point{place.x + turn, place.y}, vertex);
}

// Degrees by which the sum of the angles opposite an interior edge exceeds 180.
double delaunayExcess(const TriMesh& mesh, EdgeRef e) {
  const auto angleAtApex = [&mesh](EdgeRef edge) {
    return anglesDeg(mesh.points[mesh.apex(edge)], mesh.points[mesh.origin(edge)], mesh.points[mesh.target(edge)])[0];
  };
  return angleAtApex(e) + angleAtApex(mesh.twin(e)) - 180.0;
}

// The triangle's edge whose midpoint is nearest to `place`.
EdgeRef edgeAt(const TriMesh& mesh, TriId t, const Point& place) {
  const auto distanceTo = [&](unsigned i) {
    const Point& a = mesh.points[mesh.origin(edgeRef(t, i))];
    const Point& b = mesh.points[mesh.target(edgeRef(t, i))];
    return std::hypot((a.x + b.x) / 2 - place.x, (a.y + b.y) / 2 - place.y);
  };
  unsigned nearest = 0;
  for (unsigned i : {1u, 2u}) {
    if (distanceTo(i) < distanceTo(nearest)) nearest = i;
  }
  return edgeRef(t, nearest);
}

// True if neither rounding nor a move of a node onto the box of the frame explains the defect.
bool isClearlyNotDelaunay(const TriMesh& mesh, std::span<const std::uint8_t> moved, const MeshDefect& defect) {
  const EdgeRef e = edgeAt(mesh, defect.triangle, defect.place);
  if (mesh.twin(e) == kNone || delaunayExcess(mesh, e) <= kAngleSlackDeg) return false;
  const std::array corners{mesh.origin(e), mesh.target(e), mesh.apex(e), mesh.apex(mesh.twin(e))};
  return moved.empty() || std::ranges::none_of(corners, [moved](VertexId v) { return moved[v] != 0; });
}

// `moved`: 1 for each point of the mesh that may have been elsewhere in the plane; empty: none.
void checkPiece(const GridPiece& piece, const Pslg* pslg, std::span<const std::uint8_t> moved,
                const GridCheckOptions& options, const ItemLoop& loop, GridCheck& result) {
  std::vector<GridDefect>& defects = result.defects;
  const auto inverse = [&piece](const Point& place) { return piece.projection.inverse(place); };
  for (const EdgeConflict& conflict : piece.conflicts) {
    const Point& a = piece.mesh.points[conflict.a];
    const Point& b = piece.mesh.points[conflict.b];
    defects.push_back({DefectKind::BrokenTopology, inverse({(a.x + b.x) / 2, (a.y + b.y) / 2})});
  }
  CheckOptions check;
  check.min_angle_deg = std::max(0.0, options.min_angle_deg - kAngleSlackDeg);
  check.max_angle_deg = std::min(180.0, options.max_angle_deg + kAngleSlackDeg);
  check.delaunay = options.delaunay;
  check.pinches = options.pinches;
  check.places = piece.places;
  check.closed = !piece.places.empty() && isClosed(piece.mesh);
  BoundCounts bounds;
  const std::vector<MeshDefect> found =
      checkMesh(piece.mesh, pslg, check, loopOfPiece(piece.triangles.size(), loop), &bounds);
  result.bounds.add(bounds);
  for (const MeshDefect& defect : found) {
    if (defect.kind == DefectKind::NotDelaunay && !isClearlyNotDelaunay(piece.mesh, moved, defect)) continue;
    if (defect.kind == DefectKind::NotCounterClockwise) continue;  // tested on the ground, not in this plane
    const std::int64_t triangle = defect.triangle == kNone ? -1 : std::int64_t{piece.triangles[defect.triangle]};
    defects.push_back({defect.kind, inverse(defect.place), triangle, defect.value});
  }
}

// Checks the angles of a grid with quadrilaterals: of triangles that are no halves, and of quadrilaterals.
void checkMixedAngles(const Grid& grid, const std::vector<Quad>& quads, const GridCheckOptions& options,
                      const ItemLoop& loop, GridCheck& result) {
  GridCheck of_triangles;
  for (const GridPiece& piece : splitGrid(trianglesOnly(grid), surfaceFor(grid, options.surface), loop))
    checkPiece(piece, nullptr, {}, options, loop, of_triangles);
  result.bounds = of_triangles.bounds;
  std::ranges::copy_if(of_triangles.defects, std::back_inserter(result.defects),
                       [](const GridDefect& defect) { return defect.kind == DefectKind::AngleBelowBound; });
  for (const Quad& quad : quads) {
    const std::array<double, 4> angles = anglesOf(grid, quad);
    const auto [least, greatest] = std::ranges::minmax(angles);
    if (least >= options.min_angle_deg - kAngleSlackDeg && greatest <= options.max_angle_deg + kAngleSlackDeg) continue;
    result.defects.push_back({DefectKind::AngleBelowBound,
                              placeBetween(grid.crs, grid.nodes[quad.nodes[0]], grid.nodes[quad.nodes[2]], 0.5),
                              std::int64_t{quad.halves[0]}, least});
  }
}

// On the ground, as `mesh` does: the plane of a piece may differ from the one that the mesh was made in.
void checkOrientation(const Grid& grid, const ItemLoop& loop, std::vector<GridDefect>& defects) {
  for (const std::uint32_t t : turnedTriangles(grid, triangleAreas(grid.nodes, grid.triangles, grid.crs, loop), loop))
    defects.push_back({DefectKind::NotCounterClockwise, middleOf(grid, t), std::int64_t{t}});
}

void sortByKind(std::vector<GridDefect>& defects) {
  std::ranges::stable_sort(defects, {}, [](const GridDefect& defect) { return static_cast<int>(defect.kind); });
}

// The input's group that has most of the triangles' nodes as vertices; nullopt if none has any.
std::optional<std::size_t> groupOf(const Grid& grid, const std::vector<std::uint32_t>& triangles,
                                   const InputVertices& vertices) {
  std::map<std::size_t, std::size_t> votes;
  for (std::uint32_t t : triangles) {
    for (std::uint32_t node : grid.triangles[t]) {
      const auto found = vertices.find(grid.nodes[node]);
      if (found != vertices.end()) ++votes[found->second.group];
    }
  }
  if (votes.empty()) return std::nullopt;
  return std::ranges::max_element(votes, {}, [](const auto& vote) { return vote.second; })->first;
}

}  // namespace

SurfaceKind surfaceFor(const Grid& grid, const SurfaceChoice& choice) {
  if (!choice.needsEarth() || !grid.crs.isPlane()) return choice.kind;
  if (choice.where_known) return SurfaceKind::Plane;
  throw OptionError(std::string("--surface ") + kSurfaceNames[static_cast<std::size_t>(choice.kind)] +
                    ": the mesh has no CRS, and no place on Earth; name it with --assume-crs");
}

GridCheck checkGrid(const Grid& grid, const GridCheckOptions& options, const ItemLoop& loop) {
  GridCheck result;
  const std::vector<Quad> quads = quadsOf(grid);
  GridCheckOptions of_all = options;
  if (!quads.empty()) {
    of_all.min_angle_deg = 0.0;
    of_all.max_angle_deg = 180.0;
  }
  for (const GridPiece& piece : splitGrid(grid, surfaceFor(grid, options.surface), loop))
    checkPiece(piece, nullptr, {}, of_all, loop, result);
  if (!quads.empty()) checkMixedAngles(grid, quads, options, loop, result);
  checkOrientation(grid, loop, result.defects);
  sortByKind(result.defects);
  return result;
}

GridCheck checkGridAgainst(const Grid& grid, const JobInput& input, const GridCheckOptions& options,
                           const ItemLoop& loop) {
  std::vector<std::optional<Domain>> domains(input.groups());
  InputVertices vertices;
  for (std::size_t g = 0; g < domains.size(); ++g) {
    CleanReport ignored;
    try {
      domains[g] = input.domain(g, ignored);
    } catch (const InputError&) {
      continue;  // `mesh` leaves such a group out
    }
    for (VertexId v = 0; v < domains[g]->input_points.size(); ++v) vertices[domains[g]->input_points[v]] = {g, v};
  }
  std::optional<FrameBox> box;
  if (input.coastline().framed_by_box) {
    box.emplace(input.coastline());
    const std::vector<std::pair<Point, InputVertex>> known(vertices.begin(), vertices.end());
    for (const auto& [place, vertex] : known) vertices.emplace(box->nearest(place), vertex);
  }
  addTurns(grid, vertices);

  GridCheck result;
  std::vector<GridDefect>& defects = result.defects;
  std::vector<std::vector<std::uint32_t>> triangles_of(domains.size());
  for (const std::vector<std::uint32_t>& triangles : connectedTriangles(grid)) {
    if (const auto g = groupOf(grid, triangles, vertices)) {
      triangles_of[*g].insert(triangles_of[*g].end(), triangles.begin(), triangles.end());
    } else {
      const Point& place = grid.nodes[grid.triangles[triangles.front()][0]];
      defects.push_back({DefectKind::WrongArea, place, std::int64_t{triangles.front()}, 1.0});
    }
  }
  const LineEdges lines(grid);
  for (std::size_t g = 0; g < domains.size(); ++g) {
    if (!domains[g]) continue;
    if (triangles_of[g].empty()) {
      defects.push_back({DefectKind::MissingVertex, domains[g]->input_points.front()});
      continue;
    }
    std::ranges::sort(triangles_of[g]);
    const ItemLoop& of_piece = loopOfPiece(triangles_of[g].size(), loop);
    GridPiece piece = makePiece(grid, std::move(triangles_of[g]), domains[g]->projection, lines, of_piece);
    // Vertices that cleaning made have exact places only in the plane: projecting their rounded coordinates does not
    // give these back.
    std::vector<VertexId> vertex_of(piece.nodes.size(), kNone);
    for (std::size_t v = 0; v < piece.nodes.size(); ++v) {
      const auto found = vertices.find(grid.nodes[piece.nodes[v]]);
      if (found == vertices.end() || found->second.group != g) continue;
      vertex_of[v] = found->second.vertex;
      piece.mesh.points[v] = domains[g]->pslg.points[vertex_of[v]];
    }
    std::vector<std::uint8_t> moved;
    if (box) {
      std::vector<Point> nodes;
      for (const std::uint32_t node : piece.nodes) nodes.push_back(grid.nodes[node]);
      moved = undoMovesToFrame(piece.mesh, nodes, *box, domains[g]->pslg, vertex_of, domains[g]->projection);
    }
    checkPiece(piece, &domains[g]->pslg, moved, options, loop, result);
  }
  checkOrientation(grid, loop, defects);
  sortByKind(defects);
  return result;
}

}  // namespace coastmesh
