#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "gis/grid/grid.hpp"

namespace coastmesh {

// The functions that add, remove or reorder nodes and triangles of a finished grid: all arrays of the grid and its
// lines stay consistent, and so do its boundaries unless stated otherwise. No other code changes their number.

using GridCorners = std::array<std::uint32_t, 3>;

// The point at `share` of the way from `a` to `b`, the short way around the Earth, in their range of longitudes.
Point placeBetween(const Crs& crs, const Point& a, const Point& b, double share);
// The mean of points less than half a turn apart, consistent with `placeBetween`. REQUIRES: at least one.
Point meanPlace(const Crs& crs, std::span<const Point> places);

// Each returns the index of what was added.
std::uint32_t addNode(Grid& grid, const Point& place);  // its values are unknown (NaN)
std::uint32_t copyNode(Grid& grid, std::uint32_t source, const Point& place);
// At `placeBetween`, with interpolated values. A line along the edge from `a` to `b` is led through the node; a
// boundary is not.
std::uint32_t addNodeBetween(Grid& grid, std::uint32_t a, std::uint32_t b, double share);
// Moves a node `share` of the way towards the midpoint of `a` and `b`. Values are interpolated if those of both are
// known.
void moveNode(Grid& grid, std::uint32_t node, std::uint32_t a, std::uint32_t b, double share);
// Gives `triangles`, which share no edge of a line at the node with others, a copy of it at `place`. Lines along their
// edges use it, and are cut where they come from others; boundaries keep the node.
std::uint32_t detachTriangles(Grid& grid, std::uint32_t node, std::span<const std::uint32_t> triangles,
                              const Point& place);
std::uint32_t copyTriangle(Grid& grid, std::uint32_t source, const GridCorners& corners);

// Both return the new index of each old item, kNone for removed ones; `gone` has one flag for each. Boundaries and
// lines that lose an edge are cut there, those that lose all are dropped. Removed nodes must be in no triangle.
std::vector<std::uint32_t> removeTriangles(Grid& grid, const std::vector<bool>& gone);
std::vector<std::uint32_t> removeNodes(Grid& grid, const std::vector<bool>& gone);
std::vector<std::uint32_t> removeUnusedNodes(Grid& grid);

// Triangles, boundaries and lines get node `instead[n]` in place of node n, which stays, unused if that is another.
void replaceNodes(Grid& grid, const std::vector<std::uint32_t>& instead);

// The pieces that remain of a boundary if only the edges are kept, by their position in it, for which `holds` is true.
// Each node keeps its values; no piece of a loop is closed unless all of it remains.
std::vector<Boundary> piecesOf(const Boundary& boundary, const std::function<bool(std::size_t edge)>& holds);

// `order` has the present index of the first, the second and so on, each once.
void orderNodes(Grid& grid, const std::vector<std::uint32_t>& order);
void orderTriangles(Grid& grid, const std::vector<std::uint32_t>& order);

// The values of an array in that order; an empty one stays empty.
template <typename T, typename Allocator>
void reorder(std::vector<T, Allocator>& values, const std::vector<std::uint32_t>& order) {
  if (values.empty()) return;
  std::vector<T, Allocator> sorted;
  sorted.reserve(values.size());
  for (const std::uint32_t i : order) sorted.push_back(std::move(values[i]));
  values = std::move(sorted);
}

// Numbers the features in the order of their first triangles; unused ones are dropped.
void sortFeatures(Grid& grid);

// Appends `part` to `whole`, with its indices shifted; title and CRS are those of `whole`. Values that only one of them
// has are unknown in the other (NaN; a piece of its own); solver partitions are dropped. Pieces of `part` are numbered
// from `first_piece`, by default from one more than the largest number, which is looked up. REQUIRES: both have
// features, or neither does.
void appendGrid(Grid& whole, Grid&& part, std::optional<std::uint32_t> first_piece = std::nullopt);

// Cuts lines that do not run along an edge between two triangles.
void cutLinesOffEdges(Grid& grid);

// Throws std::logic_error if an array has the wrong length, an index is out of range, or a line is not along edges
// inside the mesh.
void requireConsistent(const Grid& grid, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
