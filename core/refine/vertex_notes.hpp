#pragma once

#include <memory>
#include <vector>

#include "core/input_corners.hpp"
#include "core/metric.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// What a run knows of vertices besides their places. Lengths are those on the surface.
struct VertexNotes {
  Surface surface;
  std::vector<double> spacing;     // one a vertex: the local feature size of the input there, from above
  std::vector<double> shell_unit;  // one an input vertex: radius of a shell round it; 0 where no small angle is there
  std::vector<bool> small_angle;   // one an input vertex: some sector of it is too small for the bounds
  std::shared_ptr<const InputCorners>
      corners;  // of the whole input, on a part of the mesh too; null where there are none
};

// Notes on a mesh as `constrainedDelaunay` made it.
VertexNotes noteInput(const TriMesh& mesh, const TriangleBound& bound);

// Gives vertices that have no spacing yet the distance to their nearest neighbour for it.
void noteSpacingOfNeighbours(const TriMesh& mesh, VertexNotes& notes);

// Makes notes on input vertices, as `noteInput` made them, notes on a mesh that has free vertices besides, of which
// those below `mesh.input_vertices` count as input.
void noteFurther(const TriMesh& mesh, VertexNotes& notes);

}  // namespace coastmesh
