#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "gis/grid/grid.hpp"

namespace coastmesh {

// What adds nodes and triangles to a finished grid, takes them out or orders them anew: all arrays of the grid and its
// lines stay right, and its boundaries where nothing else is said. Nothing else changes how many there are.

using GridCorners = std::array<std::uint32_t, 3>;

// The place at `share` of the way from `a` to `b`, the short way round the Earth, in the turn of longitudes that they
// are in.
Point placeBetween(const Crs& crs, const Point& a, const Point& b, double share);
// The mean of places less than half a turn apart, as `placeBetween` has it. REQUIRES: at least one.
Point meanPlace(const Crs& crs, std::span<const Point> places);

// Each returns the index of what was added.
std::uint32_t addNode(Grid& grid, const Point& place);  // its values are unknown (NaN)
std::uint32_t copyNode(Grid& grid, std::uint32_t source, const Point& place);
// At `placeBetween` with values in between. A line along the edge from `a` to `b` goes through the node; a boundary
// does not.
std::uint32_t addNodeBetween(Grid& grid, std::uint32_t a, std::uint32_t b, double share);
// Moves a node `share` of the way towards the middle between `a` and `b`. Values go with it, where those of both are
// known.
void moveNode(Grid& grid, std::uint32_t node, std::uint32_t a, std::uint32_t b, double share);
// Gives `triangles`, which share no edge at the node with others, a copy of it at `place`. Lines along their edges go
// with them, and are cut where they come from others; boundaries stay with the node.
std::uint32_t detachTriangles(Grid& grid, std::uint32_t node, std::span<const std::uint32_t> triangles,
                              const Point& place);
std::uint32_t copyTriangle(Grid& grid, std::uint32_t source, const GridCorners& corners);

// Both return the new index of each that there was, kNone for those taken out; `gone` has one flag each. Boundaries and
// lines that lose an edge are cut there, those that lose all are dropped. Nodes taken out must be of no triangle.
std::vector<std::uint32_t> removeTriangles(Grid& grid, const std::vector<bool>& gone);
std::vector<std::uint32_t> removeNodes(Grid& grid, const std::vector<bool>& gone);
std::vector<std::uint32_t> removeUnusedNodes(Grid& grid);

// `order` has the present index of what comes first, second and so on, each once.
void orderNodes(Grid& grid, const std::vector<std::uint32_t>& order);
void orderTriangles(Grid& grid, const std::vector<std::uint32_t>& order);

// The values that an array has in that order; an empty one stays so.
template <typename T>
void reorder(std::vector<T>& values, const std::vector<std::uint32_t>& order) {
  if (values.empty()) return;
  std::vector<T> sorted;
  sorted.reserve(values.size());
  for (const std::uint32_t i : order) sorted.push_back(std::move(values[i]));
  values = std::move(sorted);
}

// Numbers the features in the order of their first triangles; those of none are dropped.
void sortFeatures(Grid& grid);

// `part` behind `whole`, its indices shifted; the title and CRS of `whole` count. Values that one of the two does not
// have are unknown there (NaN; one piece of its own); parts of a solver are those of neither, and go. REQUIRES: both
// have features, or neither does.
void appendGrid(Grid& whole, Grid&& part);

// Cuts lines where they do not run along an edge between two triangles.
void cutLinesOffEdges(Grid& grid);

// Throws std::logic_error where an array has another length than it should, an index is out of range, or a line has
// left the edges inside the mesh.
void requireConsistent(const Grid& grid, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
