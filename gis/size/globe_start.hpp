#pragma once

#include <vector>

#include "core/item_loop.hpp"
#include "core/point.hpp"
#include "core/size_function.hpp"
#include "core/sphere/close_sphere.hpp"
#include "core/tri_mesh.hpp"
#include "gis/clean/domain.hpp"
#include "gis/size/size_source.hpp"

namespace coastmesh {

// The beginning of the mesh of a whole globe.
struct GlobeStart {
  SphereCap cap;             // around the plane's point at infinity
  std::vector<Point> seeds;  // vertices clear of the input
  TriMesh lattice;           // instead of seeds, if it is the whole mesh: see MeshOptions
};

// True if one size is requested everywhere, and nothing else but bounds.
bool isUniform(const SizeOptions& options);

// A domain of a whole globe with a small ring around the plane's point at infinity, which maps of sizes then cover. The
// areas of features count as outside, so that their borders with the rest are shores. REQUIRES: domain.closed().
Domain withRing(const Domain& domain, const SizeOptions& options);

// Lattice points where one length is requested for many triangles: everywhere, or where the largest size applies.
// Otherwise a few points, so that no triangle is as large as a continent and refinement begins with good ones. `size`
// is null if only a longest edge, or nothing, is requested. Throws InputError if the lengths require more vertices than
// can be numbered. REQUIRES: domain.closed().
GlobeStart globeStart(const Domain& domain, const SizeOptions& options, const SizeFunction* size,
                      const ItemLoop& loop = inOrder);

}  // namespace coastmesh
