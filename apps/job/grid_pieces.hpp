#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/item_loop.hpp"
#include "core/tri_mesh.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/grid.hpp"
#include "gis/projection/projection.hpp"

namespace coastmesh {

// A part of a grid as a mesh in a working plane.
struct GridPiece {
  Projection projection = Projection::plane();
  TriMesh mesh;  // regions are the grid's `feature_of`, 0 if it has none; constraints: borders between them, and lines
  // One for each point of the mesh, metres, for angles, lengths and areas; empty if the plane itself is the surface.
  std::vector<SpacePoint> places;
  std::vector<std::uint32_t> nodes;      // for each point of the mesh: the grid's node
  std::vector<std::uint32_t> triangles;  // for each triangle of the mesh: the grid's triangle
  std::vector<EdgeConflict> conflicts;   // in points of the mesh
};

// The edges of a grid's lines, each with a segment: that of its line.
class LineEdges {
 public:
  explicit LineEdges(const Grid& grid);
  // Those of quadrilaterals too, which need not be Delaunay: one more segment.
  static LineEdges andQuads(const Grid& grid);

  bool empty() const { return edges_.empty(); }
  SegmentId segmentAt(std::uint32_t a, std::uint32_t b) const;  // kNone if it is of no line

 private:
  std::vector<std::pair<NodePair, SegmentId>> edges_;  // sorted; the lesser node first
};

// The grid's triangles in pieces that share no node. Pieces, and the triangles in them, are in ascending order.
std::vector<std::vector<std::uint32_t>> connectedTriangles(const Grid& grid);

// A conformal projection fitted to the given triangles, or the identity for a grid without a place on Earth.
Projection fitProjection(const Grid& grid, const std::vector<std::uint32_t>& triangles,
                         SurfaceKind kind = SurfaceKind::Auto, const ItemLoop& loop = inOrder);

// The loop for a piece with so many triangles: small ones, of which there may be a million, are not worth threads.
const ItemLoop& loopOfPiece(std::size_t triangles, const ItemLoop& loop);

// `lines` are those of the grid, for all its pieces.
GridPiece makePiece(const Grid& grid, std::vector<std::uint32_t> triangles, const Projection& projection,
                    const LineEdges& lines, const ItemLoop& loop = inOrder);

// Every connected piece in its own projection, as `mesh` would have chosen it.
std::vector<GridPiece> splitGrid(const Grid& grid, SurfaceKind kind = SurfaceKind::Auto,
                                 const ItemLoop& loop = inOrder);

}  // namespace coastmesh
