#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

#include "core/item_loop.hpp"
#include "core/pslg.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

enum class DefectKind {
  BrokenTopology,  // neighbours that do not point back, an edge of three triangles, a corner out of range
  NotCounterClockwise,
  PinchedVertex,    // two fans of triangles meet in a vertex
  MissingVertex,    // an input vertex that bounds the domain is not in the mesh, bit for bit
  MissingSegment,   // an input segment is not a chain of edges
  NotDelaunay,      // an unconstrained edge that is not locally Delaunay
  AngleBelowBound,  // a triangle short of the bound that no corner of the input excuses
  WrongArea,        // the triangles do not cover the domain just once
  UnusedVertex,     // a Steiner point without triangles
};

std::string_view toString(DefectKind kind);

struct MeshDefect {
  DefectKind kind;
  Point place;
  TriId triangle = kNone;
  double value = 0.0;  // degrees for AngleBelowBound, relative error for WrongArea
};

struct CheckOptions {
  double min_angle_deg = 0.0;    // degrees; 0 asks nothing
  double max_angle_deg = 180.0;  // degrees; 180 asks nothing
  bool delaunay = true;
  bool pinches = false;  // report pinched vertices; the core allows them where the input has them
};

// Every defect of the mesh, by kind and then in order of triangles. `pslg` may be null: then the mesh is checked for
// itself. With it, a mesh of ours (`input_vertices` set) is compared by index; one that was read from a file by
// coordinates.
std::vector<MeshDefect> checkMesh(const TriMesh& mesh, const Pslg* pslg, const CheckOptions& options,
                                  const ItemLoop& loop = inOrder);

}  // namespace coastmesh
