#pragma once

#include <memory>
#include <vector>

#include "core/bulk_list.hpp"
#include "core/input_corners.hpp"
#include "core/item_loop.hpp"
#include "core/metric.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// A run's data on vertices besides their positions. Lengths are on the surface.
struct VertexNotes {
  Surface surface;
  BulkList<double> spacing;        // for each vertex: an upper bound of the input's local feature size there
  std::vector<double> shell_unit;  // for each input vertex: radius of a shell around it; 0 if there is no small angle
  std::vector<bool> small_angle;   // for each input vertex: whether one of its sectors is too small for the bounds
  // Of the whole input, also on a part of the mesh; null if there are none.
  std::shared_ptr<const InputCorners> corners;
};

// Notes on a mesh made by `constrainedDelaunay`.
VertexNotes noteInput(const TriMesh& mesh, const TriangleBound& bound, const ItemLoop& loop = inOrder);

// Sets the spacing of vertices that have none to the distance of their nearest neighbour.
void noteSpacingOfNeighbours(const TriMesh& mesh, VertexNotes& notes, const ItemLoop& loop = inOrder);

// Extends notes on input vertices, made by `noteInput`, to a mesh that has free vertices too, of which those below
// `mesh.input_vertices` count as input. The last vertices divide segments: they have this spacing, and do not count as
// neighbours.
void noteFurther(const TriMesh& mesh, VertexNotes& notes, const BulkList<double>& dividing = {},
                 const ItemLoop& loop = inOrder);

}  // namespace coastmesh
