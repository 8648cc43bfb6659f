#pragma once

#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "core/edit_mesh.hpp"
#include "core/item_loop.hpp"
#include "core/links.hpp"
#include "core/refine/vertex_notes.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// A mesh and its attributes between runs: the whole between two rounds, or a submesh that is worked on.
struct MeshState {
  TriMesh mesh;                             // no regions
  VertexNotes notes;                        // each list empty if not needed
  std::vector<std::uint8_t> due_triangles;  // one for each triangle, or empty: to be examined by refinement
  std::vector<std::uint8_t> due_vertices;   // one for each vertex, or empty: for coarsening and optimiser to examine
};

// Some triangles of a mesh, its parent, as a separate mesh. Edges shared with other triangles of the parent are frozen:
// they carry kFrozen in place of a segment and must be kept. The boundary of the domain stays as it is.
struct Submesh {
  TriMesh mesh;  // the first `input_vertices` are fixed: input vertices and those on frozen edges
  VertexNotes notes;
  std::vector<TriId> triangles;  // the parent's number of each triangle
  std::vector<VertexId> parent;  // the parent's number of each vertex
  std::vector<EdgeRef> frozen;   // the frozen edges, in the parent's numbers, seen from inside
};

// The parent's notes on `vertices`, as notes on a submesh that consists of them, the first `fixed` of which are fixed.
VertexNotes notesOn(std::span<const VertexId> vertices, VertexId fixed, VertexId parent_inputs,
                    const VertexNotes& notes);

// Takes these triangles out of a TriMesh or EditMesh whose first `parent_inputs` vertices are input vertices.
// `slotOf(t)`: the index of a parent's triangle in `triangles`, kNone for others. `numberOf(v)`: by reference, storage
// for the new number of a parent's vertex; kNone before, set afterwards.
template <typename Mesh, typename SlotOf, typename NumberOf>
Submesh extractSubmesh(const Mesh& parent, VertexId parent_inputs, const VertexNotes& notes,
                       std::span<const TriId> triangles, const SlotOf& slotOf, const NumberOf& numberOf) {
  Submesh sub;
  sub.triangles.assign(triangles.begin(), triangles.end());
  const auto number = [&](VertexId v) {
    VertexId& own = numberOf(v);
    if (own != kNone) return;
    own = static_cast<VertexId>(sub.parent.size());
    sub.parent.push_back(v);
  };
  // Vertices that must not change come first.
  for (const TriId t : triangles) {
    for (unsigned i = 0; i < 3; ++i) {
      const EdgeRef e = edgeRef(t, i), twin = parent.twin(e);
      if (const VertexId v = parent.apex(e); v < parent_inputs) number(v);
      // Where the parent's own boundary is frozen, it stays so.
      if (twin == kNone ? parent.segment(e) != kFrozen : slotOf(triOf(twin)) != kNone) continue;
      number(parent.origin(e));
      number(parent.target(e));
      sub.frozen.push_back(e);
    }
  }
  sub.mesh.input_vertices = static_cast<VertexId>(sub.parent.size());
  for (const TriId t : triangles)
    for (const VertexId v : parent.triangle(t).v) number(v);

  sub.mesh.points.reserve(sub.parent.size());
  for (const VertexId v : sub.parent) sub.mesh.points.push_back(parent.point(v));
  sub.notes = notesOn(sub.parent, sub.mesh.input_vertices, parent_inputs, notes);
  sub.mesh.triangles.reserve(triangles.size());
  for (const TriId t : triangles)
    sub.mesh.triangles.push_back(renumbered(parent.triangle(t), slotOf, numberOf, kFrozen));
  assert(findBrokenLink(sub.mesh.triangles) == kNone);
  return sub;
}

// Numbers for the triangles and vertices of a patch, reused for the next patch: all kNone in between.
struct PatchNumbers {
  std::vector<TriId> triangle;
  std::vector<VertexId> vertex;
};

// Some triangles, extended by `rings` layers of touching triangles.
std::vector<TriId> trianglesAround(const EditMesh& mesh, std::span<const TriId> centre, unsigned rings,
                                   PatchNumbers& scratch);

// Extracts these triangles as a submesh.
Submesh extractAround(const EditMesh& parent, const VertexNotes& notes, std::span<const TriId> centre, unsigned rings,
                      PatchNumbers& scratch);

// Puts another mesh of the same submesh (fixed vertices and frozen edges unchanged) back into the parent's mesh.
// Appends the vertices and triangles that are new there. Does not restore the Delaunay property. REQUIRES: the parent
// is unchanged since the extraction.
void putBack(EditMesh& parent, const Submesh& patch, const TriMesh& solved, std::vector<VertexId>& added,
             std::vector<TriId>& touched);

// The triangles of a mesh within a number of edges from some of them, as a mesh. `notes` are those on input vertices,
// made by `noteInput`.
Submesh extractNear(const TriMesh& parent, const VertexNotes& notes, std::span<const TriId> centre, unsigned edges,
                    const ItemLoop& loop = inOrder);

// Puts another mesh of the same submesh into its parent, as above; triangles and free vertices get new numbers, of
// which those of the triangles are returned. Leaves regions alone.
BulkList<TriId> putBack(TriMesh& parent, const Submesh& patch, const TriMesh& solved, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
