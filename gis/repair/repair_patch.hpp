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
#include "gis/grid/boundary_kinds.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/grid/on_sphere.hpp"
#include "gis/model/check_target.hpp"

namespace coastmesh {

// A few triangles of a grid, and edits of them that would mend it for models.

// An edge, whichever way it goes.
inline NodePair edgeKey(std::uint32_t a, std::uint32_t b) { return {std::min(a, b), std::max(a, b)}; }

using BoundaryKinds = std::map<NodePair, BoundaryKind>;  // by `edgeKey`

// How the grid hangs together.
struct GridLinks {
  TriMesh mesh;
  std::vector<std::vector<std::uint32_t>> triangles_at;  // one list a node
  BoundaryKinds kinds;                                   // of the boundary's edges
  std::vector<bool> on_boundary;                         // one flag a node
  std::set<NodePair> line_edges;                         // by `edgeKey`; these stay
};

class ShoreIndex;

// The time step that triangles have to leave (`timeSteps`).
struct StepBound {
  double time_step_s = 0.0;      // 0: none
  double least_angle_deg = 0.0;  // for that no smaller angles are made
  // By triangle: lengths on the ground over those of the plane that is flat there.
  std::span<const double> metres_per_unit{};
  double largest_angle_deg = 180.0;  // for that no larger angles are made
};

// What a search for repairs looks at.
struct RepairView {
  const Grid& grid;
  const GridLinks& links;
  std::span<const Target> targets;
  // By triangle, degrees: the smallest angle, less than 0 for one that is clockwise or without area; NaN where nobody
  // has asked yet. Holds for triangles that were not changed in this round.
  std::span<double> smallest_angle;
  // By node of a geographic grid: its place on the sphere; NaN where nobody has asked yet. Holds for nodes of the same
  // triangles.
  std::span<SphereVector> on_sphere{};
  StepBound step{};
  const ShoreIndex* shores = nullptr;  // nodes of the shore may move along it, and go, where there is one

  bool isFor(Target target) const { return std::ranges::count(targets, target) > 0; }
};

struct PatchEdge {
  NodePair key{};              // by `edgeKey`
  std::uint32_t triangle = 0;  // of the grid
  std::uint32_t apex = 0;      // the triangle's corner opposite
};

struct GridPatch {
  std::vector<std::uint32_t> triangles;  // of the grid, ascending

  // Their edges at a key, by triangle. Looked up: of the thousands round one node a few are asked for.
  std::vector<PatchEdge> edgesAt(const RepairView& view, const NodePair& key) const;
};

// A triangle as an edit makes it.
struct EditedTriangle {
  GridCorners v{};
  std::uint32_t slot = kNone;    // the triangle that it was; kNone for a new one
  std::uint32_t source = kNone;  // the one that it is cut from
};

enum class PatchEditKind { EdgeFlip, EdgeSplit, NodeSplit, NodeMove, EdgeCollapse };

struct PatchEdit {
  PatchEditKind kind = PatchEditKind::EdgeFlip;
  NodePair nodes{};                                     // the edge; what a node moves towards: the middle between these
  double share = 0.0;                                   // of the way along the edge, or of the move's
  std::uint32_t placed = kNone;                         // the node that is moved, or added behind the grid's last
  Point place{};                                        // of it
  double z = std::numeric_limits<double>::quiet_NaN();  // of it, as the grid's
  std::vector<EditedTriangle> triangles{};              // those that change, then new ones
  std::vector<std::uint32_t> removed{};                 // those that go
  BoundaryKinds made{};                                 // edges of the boundary that the edit makes
  std::vector<NodePair> gone{};                         // and those it takes away
};

// The corners of these triangles, ascending.
std::vector<std::uint32_t> nodesOf(const Grid& grid, std::span<const std::uint32_t> triangles);

// The triangles that share a node with one of these.
GridPatch patchRound(const RepairView& view, std::span<const std::uint32_t> middle);

// What the boundary is at the edge once the edit is made; null inside the mesh.
const BoundaryKind* kindOf(const RepairView& view, const PatchEdit& edit, std::uint32_t a, std::uint32_t b);

// The edge between two triangles of the patch turned to join their other corners; none where it has to stay.
std::optional<PatchEdit> flipOf(const RepairView& view, const GridPatch& patch, std::uint32_t a, std::uint32_t b);

// A new node on the edge, at `share` of the way.
PatchEdit splitOf(const RepairView& view, const GridPatch& patch, std::uint32_t a, std::uint32_t b, double share);

// The nodes round an inner node, counter-clockwise; empty where they do not close.
std::vector<std::uint32_t> ringRound(const RepairView& view, std::uint32_t node);

// An inner node split in two: `count` triangles from ring[first] on get a node of their own, yet to be placed. None
// where an edge that has to stay would move.
std::optional<PatchEdit> nodeSplitOf(const RepairView& view, std::uint32_t node, std::span<const std::uint32_t> ring,
                                     const std::set<std::uint32_t>& fixed, std::size_t first, std::size_t count);

// The other ends of a node's edges.
std::set<std::uint32_t> neighboursOf(const RepairView& view, std::uint32_t node);

// A node between two edges of shore of the same kind that nothing else holds.
bool isOnFreeShore(const RepairView& view, std::uint32_t node);

// Its neighbours along the boundary.
std::vector<std::uint32_t> boundaryNeighbours(const RepairView& view, std::uint32_t node);

// A node that no edge holds in its place: an inner one, or one of a shore that may move.
bool isMovable(const RepairView& view, std::uint32_t node);

// The node moved `share` of the way towards the middle between `a` and `b`, nodes of its ring.
PatchEdit moveOf(const RepairView& view, std::uint32_t node, std::uint32_t a, std::uint32_t b, double share);

// NaN where it is not known at both; metres, positive up.
double zBetween(const Grid& grid, std::uint32_t a, std::uint32_t b, double share);

// The other ends of edges at a node that have to stay: parts of lines, and those where features meet.
std::set<std::uint32_t> fixedNeighbours(const RepairView& view, std::uint32_t node);

}  // namespace coastmesh
