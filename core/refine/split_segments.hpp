#pragma once

#include "core/item_loop.hpp"
#include "core/pslg.hpp"
#include "core/refine/refine_options.hpp"
#include "core/refine/vertex_notes.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// Divides segments evenly into pieces of the requested length, or no longer than the maximum edge if only that is
// given, before refinement: repeated halving would end anywhere between the length and half of it. Segments shorter
// than the requested length are kept. REQUIRES: lengths are given; `mesh` has no Steiner points except those of a
// lattice. The mesh stays constrained Delaunay; `notes`, of `noteInput`, are extended. At most `options.max_vertices`
// vertices. Returns how many were inserted.
std::uint64_t splitSegments(TriMesh& mesh, const Pslg& pslg, VertexNotes& notes, const RefineOptions& options,
                            const ItemLoop& loop = inOrder);

// True if segments should be divided first: if lengths are requested, and beside a lattice, whose points the circle of
// a long side would exclude. Without a lattice, a maximum edge is as well reached step by step.
bool wantsSplitSegments(const TriMesh& mesh, const RefineOptions& options);

}  // namespace coastmesh
