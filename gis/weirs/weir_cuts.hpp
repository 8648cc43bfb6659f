#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/tri_mesh.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// Triangles around a node between two of its edges, counter-clockwise: `first` and `last` are the nodes across these.
struct NodeSector {
  std::vector<std::uint32_t> triangles;
  std::uint32_t first = kNone, last = kNone;
  bool first_is_cut = false, last_is_cut = false;  // otherwise the edge is on the shore
};

// Edges one after another with pairs of nodes at both ends: both are divided in two. `edges` run along it, with the
// front to their left.
struct WeirRun {
  std::vector<EdgeRef> edges;
  bool closed = false;
};

// Where the mesh is cut along lines, and what nodes become.
struct WeirCuts {
  std::map<NodePair, std::uint32_t> line_of;                 // by `edgeKey`: the edges that are cut, and their lines
  std::map<std::uint32_t, std::vector<NodeSector>> sectors;  // of each node that is divided, at least two
  std::vector<WeirRun> runs;
};

// A line that cannot be opened, and why.
struct ClosedLine {
  std::uint32_t line = 0;
  Point place;
  std::string why;
};

// Plans to cut the mesh along the lines (indices in `grid.lines`, ascending) as far as that leaves a mesh that models
// accept. Nodes are divided wherever an edge that is cut goes on, or reaches a shore; where three or more meet, each
// sector gets a node of its own, but no pair. Edges that touch an open boundary or a river, or a node where the mesh
// touches itself, stay whole. So do lines that leave no pair of edges with nodes across, and those that would leave a
// triangle alone: they are appended to `closed`. `mesh`: the grid's, linked.
WeirCuts planWeirCuts(const Grid& grid, const TriMesh& mesh, std::vector<std::uint32_t> lines,
                      std::vector<ClosedLine>& closed);

}  // namespace coastmesh
