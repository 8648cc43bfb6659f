#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "core/pslg.hpp"
#include "core/refine/mesh_defect.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// Compares a mesh of ours with the PSLG that it was made from: vertices bit for bit, segments as chains of edges, area.
// `used` is what `usedVertices` says of the mesh.
void checkAgainstInput(const TriMesh& mesh, std::span<const std::uint8_t> used, const Pslg& pslg, const ItemLoop& loop,
                       std::vector<MeshDefect>& defects);

// The same for a mesh that was read from a file: vertices are matched by their coordinates, segments by walking along
// edges. Edges that are found to be pieces of a segment are marked in the mesh.
void checkAgainstInputByPlace(TriMesh& mesh, const Pslg& pslg, std::vector<MeshDefect>& defects);

}  // namespace coastmesh
