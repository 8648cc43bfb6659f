#pragma once

#include <cstddef>
#include <vector>

#include "core/refine/submesh.hpp"
#include "parallel/partition.hpp"

namespace coastmesh {

// An edge along which the mesh was cut.
struct CutEdge {
  VertexId a = kNone, b = kNone;  // in the submesh's numbers, the submesh to the left of a -> b
  EdgeRef name = kNone;           // the same on both sides
  SegmentId seg = kNone;          // what kFrozen stands for
};

// A piece of a partition, cut out, and how it hangs together with the others.
struct CutSubmesh {
  MeshState state;
  std::vector<VertexId> fixed;  // the number in the whole of each of the first `input_vertices` vertices
  std::vector<CutEdge> edges;   // by a, then b
};

// Scratch of one thread: the local number of each vertex of the whole, kNone between calls.
using VertexNumbers = std::vector<VertexId>;

CutSubmesh cutOut(const MeshState& whole, const Partition& partition, PieceId piece, VertexNumbers& numbers);

// Puts together again what `before` was cut into: all pieces of one partition, in order, each worked on or not.
// Restores the Delaunay property across the cuts and marks the triangles that this changes as due. Vertices are
// numbered anew: input vertices as before, then those on cuts, then each piece's own. What `whole` holds is lost but
// for its memory, which serves again: fresh memory costs more than what is written to it.
void stitch(std::vector<CutSubmesh>&& pieces, const MeshState& before, Recorder& recorder, MeshState& whole);

}  // namespace coastmesh
