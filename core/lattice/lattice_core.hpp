#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/divided_segments.hpp"
#include "core/item_loop.hpp"
#include "core/lattice/lattice.hpp"
#include "core/lattice/lattice_rows.hpp"
#include "core/pslg.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// Triangles of a lattice so far inside that no change around the lattice affects them: they are kept out of a mesh
// while it is refined, and inserted at the end.
struct LatticeCore {
  Lattice lattice;
  LatticeRows edge;      // the core's boundary: always vertices of the mesh
  LatticeRows interior;  // the core's other corners
  LatticeRows up, down;  // its triangles, by their lattice coordinates (a, b)
};

// The mesh of a PSLG and of lattice points, ready to be refined.
struct LatticeMesh {
  // The first vertices are the PSLG's, then those on the boundaries of cores; edges there are kFrozen, and
  // `input_vertices` counts both. The other lattice points follow, and those that divide segments.
  TriMesh mesh;
  VertexId pslg_vertices = 0;
  std::vector<LatticeCore> cores;

  std::uint64_t coreVertices() const;  // interior ones
  std::uint64_t coreTriangles() const;
};

// Triangulates a PSLG with the lattice points in its domain, and with its segments divided as given, if at all.
// `with_cores` keeps the inner triangles of lattices out. REQUIRES: points found by `layLattices`.
LatticeMesh triangulateWith(const Pslg& pslg, std::vector<LatticePlaces> lattices, bool with_cores,
                            const DividedSegments& divided = {}, const ItemLoop& loop = inOrder);

// Inserts the cores into the mesh, which may have been refined, with `input_vertices` unchanged. Afterwards it counts
// only the PSLG's, and no edge is frozen. Does not set regions.
void insertCores(TriMesh& mesh, VertexId pslg_vertices, const std::vector<LatticeCore>& cores,
                 const ItemLoop& loop = inOrder);

}  // namespace coastmesh
