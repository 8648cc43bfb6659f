#pragma once

#include <cstdint>
#include <vector>

#include "core/item_loop.hpp"
#include "core/point.hpp"
#include "core/space_point.hpp"
#include "core/surface.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// A lattice of equilateral triangles on an icosahedron (Caspar, Klug, "Physical principles in the construction of
// regular viruses", 1962): the path from one corner to the next is h steps, a left turn of 60 degrees, and k steps.
struct SphereLattice {
  std::int64_t h = 1, k = 0;  // 0 <= k <= h, h > 0

  std::int64_t trianglesOfFace() const { return h * h + h * k + k * k; }
  std::int64_t triangles() const { return 20 * trianglesOfFace(); }
  std::int64_t vertices() const { return 10 * trianglesOfFace() + 2; }
};

// The lattice whose edges are closest to this length, on the sphere of radius 1; one without turns (k = 0), whose
// triangles are better, if its edges are within a hundredth. REQUIRES: at least `kLeastLatticeEdge`.
SphereLattice sphereLattice(double edge);

// Finer lattices would exceed the range of edge numbers, which are four times those of triangles.
inline constexpr double kLeastLatticeEdge = 1.7e-4;

// The first points of a lattice: a pole and its neighbours.
inline constexpr std::size_t kLatticePole = 1, kLatticeRing = 5;

// A lattice's points on the sphere of radius 1, each once. The first is the pole (0, 0, -1), the next five are its
// neighbours, counter-clockwise in the plane projected from there. Edges are 0.9 to 1.1 of their mean, angles 49 to 77
// degrees; without turns 54 to 72.
std::vector<SpacePoint> placesOf(const SphereLattice& lattice, const ItemLoop& loop = inOrder);

// The closed mesh of a lattice without turns, in the plane of a curved surface: its vertices in the same order except
// the pole, which is last, as far from the origin as in a `SphereCap`. Without regions; no vertex is input. REQUIRES: k
// = 0, h > 1, and edges of at least `kLeastLatticeEdge`.
TriMesh meshOf(const SphereLattice& lattice, const Surface& surface, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
