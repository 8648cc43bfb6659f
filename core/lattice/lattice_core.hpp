#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/item_loop.hpp"
#include "core/lattice/lattice.hpp"
#include "core/lattice/lattice_rows.hpp"
#include "core/pslg.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// The triangles of a lattice that lie so far inside that nothing round it changes them: they are kept out of a mesh
// while that is refined, and put into it at the end.
struct LatticeCore {
  Lattice lattice;
  LatticeRows edge;      // the core's boundary: vertices of the mesh in any case
  LatticeRows interior;  // the core's other corners
  LatticeRows up, down;  // its triangles, by their place (a, b)
};

// The mesh of a PSLG and of the places of lattices, to be refined.
struct LatticeMesh {
  // The first vertices are the PSLG's, then those on the boundary of cores; edges there are kFrozen, and
  // `input_vertices` counts both. The other places follow.
  TriMesh mesh;
  VertexId pslg_vertices = 0;
  std::vector<LatticeCore> cores;

  std::uint64_t coreVertices() const;  // interior ones
  std::uint64_t coreTriangles() const;
};

// Triangulates a PSLG with the places of lattices in its domain. `with_cores` keeps their inner triangles out.
// REQUIRES: the places as `layLattices` found them.
LatticeMesh triangulateWith(const Pslg& pslg, std::vector<LatticePlaces> lattices, bool with_cores,
                            const ItemLoop& loop = inOrder);

// Puts the cores into the mesh, which may have been refined, with `input_vertices` unchanged; it counts the PSLG's
// alone then, and no edge is frozen any more. Fills no regions.
void insertCores(TriMesh& mesh, VertexId pslg_vertices, const std::vector<LatticeCore>& cores,
                 const ItemLoop& loop = inOrder);

}  // namespace coastmesh
