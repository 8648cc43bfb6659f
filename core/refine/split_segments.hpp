#pragma once

#include "core/pslg.hpp"
#include "core/refine/refine_options.hpp"
#include "core/refine/vertex_notes.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// Cuts segments into even pieces of the length wanted there, before anything is refined: halves of halves come out
// anywhere between the length and half of it. Segments that are shorter than wanted stay whole. REQUIRES:
// `options.size`; `mesh` has no Steiner points. The mesh stays constrained Delaunay; `notes`, of `noteInput`, get the
// new vertices'. At most `options.max_vertices` vertices. Returns how many were put in.
std::uint64_t splitSegments(TriMesh& mesh, const Pslg& pslg, VertexNotes& notes, const RefineOptions& options);

}  // namespace coastmesh
