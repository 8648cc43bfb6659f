#pragma once

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "core/input_corners.hpp"
#include "core/item_loop.hpp"
#include "core/pslg.hpp"
#include "core/refine/mesh_defect.hpp"
#include "core/space_point.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

struct CheckOptions {
  double min_angle_deg = 0.0;    // degrees; 0 asks nothing
  double max_angle_deg = 180.0;  // degrees; 180 asks nothing
  bool delaunay = true;
  std::span<const SpacePoint> places = {};  // one a point of the mesh, for angles; none: those of the plane
  // The mesh goes round a sphere, and has `places`: the plane shows one triangle, or a few, from the other side. They
  // run counter-clockwise in space as all others do, and nothing is asked of circles through their corners.
  bool closed = false;
  bool pinches = false;              // report pinched vertices; the core allows them where the input has them
  const PslgCover* cover = nullptr;  // of the PSLG, by its first triangulation, for a mesh of ours; none: worked out
};

// Every defect of the mesh, by kind and then in order of triangles. `pslg` may be null: then the mesh is checked for
// itself. With it, a mesh of ours (`input_vertices` set) is compared by index; one that was read from a file by
// coordinates. `bounds` may be null: it receives how many triangles break the bounds, those that are excused too; none
// where the mesh does not hold together.
std::vector<MeshDefect> checkMesh(const TriMesh& mesh, const Pslg* pslg, const CheckOptions& options,
                                  const ItemLoop& loop = inOrder, BoundCounts* bounds = nullptr);

}  // namespace coastmesh
