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

// What the mesh of a whole globe begins with.
struct GlobeStart {
  SphereCap cap;             // round the place that lies beyond all of the plane
  std::vector<Point> seeds;  // vertices clear of the input
  TriMesh lattice;           // in place of seeds, where it is all that there is: see MeshOptions
};

// Whether one length is asked for, everywhere.
bool isUniform(const SizeOptions& options);

// A domain that is a whole globe, with a small ring round the place beyond the plane, for maps of sizes to cover. What
// features hold lies outside, so that borders with the rest are shores. REQUIRES: domain.closed().
Domain withRing(const Domain& domain, const SizeOptions& options);

// Vertices of a lattice where one length is wanted over many triangles: everywhere, or where the greatest rules. Else
// few, so that no triangle is as large as a continent and refinement begins with good ones. `size` is null where a
// longest edge alone, or nothing, is asked for. Throws InputError where lengths ask for more vertices than can be
// numbered. REQUIRES: domain.closed().
GlobeStart globeStart(const Domain& domain, const SizeOptions& options, const SizeFunction* size,
                      const ItemLoop& loop = inOrder);

}  // namespace coastmesh
