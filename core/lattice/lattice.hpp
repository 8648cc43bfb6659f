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

// The places of one lattice that are to be vertices.
struct LatticePlaces {
  Lattice lattice;
  LatticeRows places;
};

// What a lattice is laid for.
struct LatticeWishes {
  double size_max = std::numeric_limits<double>::infinity();  // longest edge, plane units
  const SizeFunction* size = nullptr;                         // lengths wanted; null where none are
  double min_angle_deg = 0.0, max_angle_deg = 180.0;          // what every triangle is to hold
  std::uint64_t most_places = 0;                              // of all lattices together
};

// Where one length is wanted over many triangles, equilateral ones of that length are the best and the fewest: the
// places of lattices that lie in the domain of a mesh made by `constrainedDelaunay`, clear of its segments and points,
// where the lattice's spacing is about the length wanted. One lattice for each such length. None where neither a
// longest edge nor lengths are asked for, or where that would be more places than allowed. The same for any number of
// threads. Cost: of the order of the vertices that there will be.
std::vector<LatticePlaces> layLattices(const TriMesh& mesh, const LatticeWishes& wishes,
                                       const ItemLoop& loop = inOrder);

}  // namespace coastmesh
