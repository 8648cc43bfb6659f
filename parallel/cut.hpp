#pragma once

#include <cstddef>
#include <vector>

#include "core/refine/submesh.hpp"
#include "parallel/partition.hpp"

namespace coastmesh {

// An edge along which the mesh was cut.
struct CutEdge {
  VertexId a = kNone, b = kNone;  // in the submesh's numbers, with the submesh to the left of a -> b
  EdgeRef name = kNone;           // the same on both sides
  EdgeRef beyond = kNone;         // the other side, in the whole mesh's numbers, if it is in no piece
  SegmentId seg = kNone;          // the segment that kFrozen replaces
};

// A piece of a partition, cut out, with its connections to the others.
struct CutSubmesh {
  MeshState state;
  std::vector<VertexId> fixed;  // the number in the whole mesh of each of the first `input_vertices` vertices
  std::vector<VertexId> own;    // the numbers in the whole mesh of its own vertices, before it is worked on
  std::vector<CutEdge> edges;   // sorted by a, then b
};

// Per-thread scratch: the local number of each vertex of the whole mesh, kNone between calls.
using VertexNumbers = std::vector<VertexId>;

CutSubmesh cutOut(const MeshState& whole, const Partition& partition, PieceId piece, VertexNumbers& numbers);

}  // namespace coastmesh
