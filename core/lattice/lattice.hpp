#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "core/item_loop.hpp"
#include "core/lattice/lattice_rows.hpp"
#include "core/point.hpp"
#include "core/size_function.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// Corners of equilateral triangles, rows along x:
//
//        (0, 1)---(1, 1)       Place (a, b) of row b lies at `origin` + a (s, 0) + b (s/2, s √3/2), s the spacing.
//         /  \     /  \        To its upper right lies the upward triangle (a, b), (a + 1, b), (a, b + 1), and beside
//        / up \   /    \       that the downward triangle (a + 1, b), (a + 1, b + 1), (a, b + 1).
//       /      \ / down \      .
//    (0, 0)---(1, 0)---(2, 0)
struct Lattice {
  Point origin;
  double spacing = 0.0;

  Point at(std::int64_t a, std::int64_t b) const;
};

// The points of one lattice that become vertices.
struct LatticePlaces {
  Lattice lattice;
  LatticeRows places;
};

// The requirements for lattices.
struct LatticeWishes {
  double size_max = std::numeric_limits<double>::infinity();  // longest edge, plane units
  const SizeFunction* size = nullptr;                         // requested lengths; null if there are none
  double min_angle_deg = 0.0, max_angle_deg = 180.0;          // bounds on every triangle
  std::uint64_t most_places = 0;                              // of all lattices together
};

// Where the requested length is constant over many triangles, equilateral triangles of that length are the best and the
// fewest. Returns the points of such lattices within the domain of a mesh made by `constrainedDelaunay`, clear of its
// segments and points: one lattice for each length. None if neither a maximum edge length nor lengths are given. Omits
// lattices that would exceed `most_places`. The same for any number of threads. Cost: proportional to the expected
// vertices.
std::vector<LatticePlaces> layLattices(const TriMesh& mesh, const LatticeWishes& wishes,
                                       const ItemLoop& loop = inOrder);

}  // namespace coastmesh
