#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "core/pslg.hpp"
#include "core/refine/mesh_defect.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// True if segments are labelled and every point is on one: labels do not define whether other points are inside.
bool labelsTellAll(const Pslg& pslg);

// The part covered by the first triangulation of a PSLG, which has no other vertices: the domain, if labels do not
// fully define it.
PslgCover coverOf(const TriMesh& coarse, const Pslg& pslg);

// Compares our own mesh with the PSLG that it was made from: vertices bit for bit, segments as chains of edges, area.
// `used` is the result of `usedVertices`; `known` is the cover of the domain, computed if null.
void checkAgainstInput(const TriMesh& mesh, std::span<const std::uint8_t> used, const Pslg& pslg,
                       const PslgCover* known, const ItemLoop& loop, std::vector<MeshDefect>& defects);

// The same for a mesh from a file: vertices are matched by their coordinates, segments by walking along edges. Edges
// that are part of a segment are marked in the mesh.
void checkAgainstInputByPlace(TriMesh& mesh, const Pslg& pslg, std::vector<MeshDefect>& defects);

}  // namespace coastmesh
