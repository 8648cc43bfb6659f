#pragma once

#include <cstdint>
#include <vector>

#include "core/edit_mesh.hpp"
#include "core/refine.hpp"
#include "core/tri_mesh.hpp"
#include "core/vertex_notes.hpp"

namespace coastmesh {

// A part of a larger mesh as a mesh of its own, to be worked on while others work on the other parts. The edges that it shares with
// them carry kFrozen in place of a segment. Nothing next to them is changed, so that every part stays Delaunay with its neighbours
// whatever these do; what would have to be changed there is due, and waits for the mesh to be cut elsewhere.
struct Piece {
  TriMesh mesh;  // the first `input_vertices` stay as they are: input vertices, and those on frozen edges; no regions
  VertexNotes notes;                        // of the local vertices
  std::vector<std::uint8_t> due_triangles;  // one a triangle: to be looked at by refinement
  std::vector<std::uint8_t> due_vertices;   // one a vertex: to be looked at by shrinking
};

// Handles the bad ones of the due triangles, and what follows from that; with `mends` also repairs what that leaves. Afterwards those
// that a frozen edge was in the way of are due. Bad triangles that are not due, before or after, are such that no point helps.
// `options.max_vertices` counts the piece's own. `steiner_points` and `unresolved` of the result stay empty. Throws Cancelled.
RefineStats refinePiece(Piece& piece, const Pslg& pslg, const RefineOptions& options, bool mends,
                        const RunControl& control = {});

// Takes out and merges the due vertices where the bounds do not need them. Afterwards those that a frozen edge was in the way of are
// due; due triangles and notes are not kept. Throws Cancelled.
RefineStats shrinkPiece(Piece& piece, const Pslg& pslg, const RefineOptions& options, const RunControl& control = {});

// The piece that was worked on in `mesh`. Of its due vertices (one a slot) those stay due that a frozen edge holds, or runs beside.
Piece releaseDue(EditMesh& mesh, std::vector<std::uint8_t> due);

}  // namespace coastmesh
