#pragma once

#include "core/pslg.hpp"
#include "core/refine/refine_options.hpp"
#include "core/refine/vertex_notes.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// Cuts segments into even pieces of the length wanted there, or no longer than the longest edge where there is but
// that, before anything is refined: halves of halves come out anywhere between the length and half of it. Segments that
// are shorter than wanted stay whole. REQUIRES: lengths are given; `mesh` has no Steiner points but those of a lattice.
// The mesh stays constrained Delaunay; `notes`, of `noteInput`, get the new vertices'. At most `options.max_vertices`
// vertices. Returns how many were put in.
std::uint64_t splitSegments(TriMesh& mesh, const Pslg& pslg, VertexNotes& notes, const RefineOptions& options);

// Whether that is to be done first: where lengths are wanted, and beside a lattice, of which a long side would clear
// its circle before it is split. Without one a longest edge is as well made step by step.
bool wantsSplitSegments(const TriMesh& mesh, const RefineOptions& options);

}  // namespace coastmesh
