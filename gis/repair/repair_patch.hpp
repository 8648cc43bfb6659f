#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <vector>

#include "core/tri_mesh.hpp"
#include "gis/check/check_target.hpp"
#include "gis/grid/boundary_kinds.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/grid/on_sphere.hpp"

namespace coastmesh {

// A few triangles of a grid, and candidate edits of them that may repair it for models.

inline bool isShore(const BoundaryKind& kind) {
  return kind.role == BoundaryRole::Land || kind.role == BoundaryRole::Island;
}

using BoundaryKinds = std::map<NodePair, BoundaryKind>;  // by `edgeKey`

// The adjacency of a grid.
struct GridLinks {
  TriMesh mesh;
  std::vector<std::vector<std::uint32_t>> triangles_at;  // one list a node
  BoundaryKinds kinds;                                   // of boundary edges
  std::vector<bool> on_boundary;                         // one flag a node
  std::vector<bool> on_opening;                          // of open boundaries; one flag a node
  std::set<NodePair> line_edges;                         // by `edgeKey`, also of quadrilaterals; these must stay
  std::vector<NodePair> quad_edges;                      // of `edgesOfQuads`; these must stay whole
  std::vector<bool> asked;                               // one flag a node, or empty; these must stay

  bool isOfQuad(const NodePair& key) const { return std::ranges::binary_search(quad_edges, key); }
  bool isAsked(std::uint32_t node) const { return node < asked.size() && asked[node]; }
};

// Sets `on_boundary` and `on_opening` from `kinds`.
void flagBoundaryNodes(GridLinks& links, std::size_t nodes);

class CrsMap;
class ShoreIndex;

// The time step that triangles must allow (`timeSteps`), and the lengths of edges.
struct StepBound {
  double time_step_s = 0.0;      // 0: none
  double least_angle_deg = 0.0;  // repairs for the time step make no smaller angles
  // By triangle: length on the ground per unit of its local plane; set if any of these bounds lengths.
  std::span<const double> metres_per_unit{};
  double largest_angle_deg = 180.0;  // repairs for the time step make no larger angles
  double least_edge_m = 0.0;         // as in RepairOptions
};

// The grid as searches for repairs see it.
struct RepairView {
  const Grid& grid;
  const GridLinks& links;
  std::span<const Target> targets;
  // By triangle, degrees: the smallest angle; negative for a triangle that is clockwise or without area, NaN until
  // computed. Valid for triangles not changed in this round.
  std::span<double> smallest_angle;
  // By node of a geographic grid: its place on `shape`; NaN until computed. Valid for nodes of the same triangles.
  std::span<SphereVector> in_space{};
  StepBound step{};
  const ShoreIndex* shores = nullptr;        // if set, nodes may move along the boundary, or be removed
  EarthShape shape = EarthShape::Ellipsoid;  // on which angles are measured
  // Set if a model measures in longitudes and latitudes what lies in a projected CRS; those of nodes as in `in_space`.
  const CrsMap* to_earth = nullptr;
  std::span<Point> on_earth{};

  bool isFor(Target target) const { return std::ranges::count(targets, target) > 0; }
};

struct PatchEdge {
  NodePair key{};              // by `edgeKey`
  std::uint32_t triangle = 0;  // of the grid
  std::uint32_t apex = 0;      // the opposite corner of the triangle
};

struct GridPatch {
  std::vector<std::uint32_t> triangles;  // of the grid, ascending

  // The edges with this key, by triangle. Computed on demand: of the thousands around one node, only a few are needed.
  std::vector<PatchEdge> edgesAt(const RepairView& view, const NodePair& key) const;
};

// A triangle as an edit makes it.
struct EditedTriangle {
  GridCorners v{};
  std::uint32_t slot = kNone;    // the triangle that it replaces; kNone for a new one
  std::uint32_t source = kNone;  // the triangle that it is cut from
};

enum class PatchEditKind { EdgeFlip, EdgeSplit, NodeSplit, NodeMove, EdgeCollapse, CornerCut };

struct PatchEdit {
  PatchEditKind kind = PatchEditKind::EdgeFlip;
  NodePair nodes{};                                     // the edge's ends; a moved node moves towards their midpoint
  double share = 0.0;                                   // share of the way along the edge, or of the move
  std::uint32_t placed = kNone;                         // the node that is moved, or added as the grid's last
  Point place{};                                        // of `placed`
  double z = std::numeric_limits<double>::quiet_NaN();  // of `placed`: metres, positive up
  std::vector<EditedTriangle> triangles{};              // changed triangles, then new ones
  std::vector<std::uint32_t> removed{};                 // removed triangles
  BoundaryKinds made{};                                 // boundary edges that the edit makes
  std::vector<NodePair> gone{};                         // boundary edges that it removes
};

// The corners of the triangles, each once, ascending.
std::vector<std::uint32_t> nodesOf(const Grid& grid, std::span<const std::uint32_t> triangles);

// The triangles that share a node with one of these.
GridPatch patchRound(const RepairView& view, std::span<const std::uint32_t> middle);

// The boundary kind of the edge after the edit; null for an inner edge.
const BoundaryKind* kindOf(const RepairView& view, const PatchEdit& edit, std::uint32_t a, std::uint32_t b);

// A node's part of the boundary after the edit.
enum class NodeMark { Inner, Shore, Open };
NodeMark markOf(const RepairView& view, const PatchEdit& edit, std::uint32_t node);

// Flips the edge between two triangles of the patch. Returns nullopt if the edge must stay, or lacks one of the
// triangles.
std::optional<PatchEdit> flipOf(const RepairView& view, const GridPatch& patch, std::uint32_t a, std::uint32_t b);

// Splits the edge by a new node at `share` of the way.
PatchEdit splitOf(const RepairView& view, const GridPatch& patch, std::uint32_t a, std::uint32_t b, double share);

// The neighbours of an inner node, counter-clockwise; empty if they do not form a closed ring. REQUIRES: the node has a
// triangle.
std::vector<std::uint32_t> ringRound(const RepairView& view, std::uint32_t node);

// Splits an inner node in two: `count` triangles from ring[first] on get a new node, whose place the caller sets.
// Returns nullopt if an edge that must stay would move.
std::optional<PatchEdit> nodeSplitOf(const RepairView& view, std::uint32_t node, std::span<const std::uint32_t> ring,
                                     const std::set<std::uint32_t>& fixed, std::size_t first, std::size_t count);

// The other ends of a node's edges.
std::set<std::uint32_t> neighboursOf(const RepairView& view, std::uint32_t node);

// The neighbours of a node along boundary edges.
std::vector<std::uint32_t> boundaryNeighbours(const RepairView& view, std::uint32_t node);

// The neighbours of a boundary node towards which it may slide if boundaries may move. Both, if its two boundary edges
// have the same kind, those of an opening in line, as on a side of the frame; where a shore meets an open boundary, the
// one along the open boundary, which gets shorter. None for a node that was requested or has an edge that must stay.
std::vector<std::uint32_t> slideNeighbours(const RepairView& view, std::uint32_t node);

// True if the node may move: it is an inner node that nobody requested and where no edge that must stay ends, or it may
// slide.
bool isMovable(const RepairView& view, std::uint32_t node);

// Moves the node `share` of the way towards the midpoint of `a` and `b`, nodes of its ring.
PatchEdit moveOf(const RepairView& view, std::uint32_t node, std::uint32_t a, std::uint32_t b, double share);

// Interpolated z: metres, positive up; NaN unless known at both nodes.
double zBetween(const Grid& grid, std::uint32_t a, std::uint32_t b, double share);

// The other ends of a node's edges that must stay: parts of lines, and edges where features meet.
std::set<std::uint32_t> fixedNeighbours(const RepairView& view, std::uint32_t node);

}  // namespace coastmesh
