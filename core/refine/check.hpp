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
  double min_angle_deg = 0.0;    // degrees; 0: no bound
  double max_angle_deg = 180.0;  // degrees; 180: no bound
  bool delaunay = true;
  std::span<const SpacePoint> places = {};  // one for each point of the mesh, for angles; empty: the plane's
  // The mesh covers a whole sphere, and has `places`: in the plane one or a few triangles are reversed. In space they
  // are counter-clockwise like all others; their circumcircles are not tested.
  bool closed = false;
  bool pinches = false;              // report pinched vertices, which the core allows where the input has them
  const PslgCover* cover = nullptr;  // of the PSLG, from its first triangulation, for our own meshes; null: computed
};

// Every defect of the mesh, by kind and then in the order of triangles. `pslg` may be null: then only the mesh itself
// is checked. With it, our own mesh (`input_vertices` set) is compared by index, a mesh from a file by coordinates.
// `bounds` may be null: it receives the number of triangles that miss the bounds, excused ones included; none if the
// mesh is not consistent.
std::vector<MeshDefect> checkMesh(const TriMesh& mesh, const Pslg* pslg, const CheckOptions& options,
                                  const ItemLoop& loop = inOrder, BoundCounts* bounds = nullptr);

}  // namespace coastmesh
