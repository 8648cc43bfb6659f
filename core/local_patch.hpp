#pragma once

#include <span>
#include <vector>

#include "core/edit_mesh.hpp"
#include "core/refiner.hpp"

namespace coastmesh {

// A piece of a mesh as a mesh of its own. Its rim is frozen, except where it is the rim of the whole domain.
struct LocalPatch {
  std::vector<TriId> triangles;  // in the parent
  std::vector<RimEdge> frozen;   // the frozen rim, in the parent's numbers
  std::vector<VertexId> parent;  // the parent's number of a local vertex
  TriMesh mesh;                  // the first `input_vertices` are fixed: input vertices and those on the frozen rim
  VertexNotes notes;
};

// Some triangles, those that touch them, those that touch these, and so on for `rings` rings.
std::vector<TriId> trianglesAround(const EditMesh& mesh, std::span<const TriId> centre, unsigned rings);

// Those triangles as a mesh.
LocalPatch extractPatch(const EditMesh& parent, const VertexNotes& notes, std::span<const TriId> centre,
                        unsigned rings);

// Puts another mesh of the same patch (fixed vertices and frozen rim unchanged) into the parent's mesh. Appends the
// vertices and the triangles that are new there. Does not restore the Delaunay property.
void putBack(EditMesh& parent, const LocalPatch& patch, const TriMesh& solved, std::vector<VertexId>& added,
             std::vector<TriId>& touched);

}  // namespace coastmesh
