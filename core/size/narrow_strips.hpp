#pragma once

#include "core/ids.hpp"
#include "core/item_loop.hpp"
#include "core/point.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// Parts of the domain between segments that are far closer to each other than they are long.
struct NarrowStrips {
  double vertices = 0.0;  // that bounds on angles take there, about
  double length = 0.0;    // of all strips, about
  // Of the pair of segments that takes the most.
  Point place;         // where they are closest
  double width = 0.0;  // there
  RegionId region = 0;
};

// Estimates the vertices that refinement without requested lengths makes in strips, for a constrained Delaunay
// triangulation that is not refined yet: between two shores it divides each into pieces as long as the other is far.
// Returns nothing if that is surely less than `worth`, or than a vertex of the mesh each: usual domains cost a look at
// each triangle.
NarrowStrips narrowStrips(const TriMesh& mesh, double worth, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
