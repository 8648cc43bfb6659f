#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "core/pslg.hpp"
#include "core/refine/mesh_defect.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// Labels on segments say what the domain is, but not whether a point without segments lies in it.
bool labelsTellAll(const Pslg& pslg);

// What the first triangulation of a PSLG covers, which has no vertices but its own: the domain, where labels do not
// tell all.
PslgCover coverOf(const TriMesh& coarse, const Pslg& pslg);

// Compares a mesh of ours with the PSLG that it was made from: vertices bit for bit, segments as chains of edges, area.
// `used` is what `usedVertices` says of the mesh; `known` is what the domain covers, or null: then it is worked out.
void checkAgainstInput(const TriMesh& mesh, std::span<const std::uint8_t> used, const Pslg& pslg,
                       const PslgCover* known, const ItemLoop& loop, std::vector<MeshDefect>& defects);

// The same for a mesh that was read from a file: vertices are matched by their coordinates, segments by walking along
// edges. Edges that are found to be pieces of a segment are marked in the mesh.
void checkAgainstInputByPlace(TriMesh& mesh, const Pslg& pslg, std::vector<MeshDefect>& defects);

}  // namespace coastmesh
