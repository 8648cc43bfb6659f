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
  EdgeRef beyond = kNone;         // the other side, in the whole's numbers, where that belongs to no piece
  SegmentId seg = kNone;          // what kFrozen stands for
};

// A piece of a partition, cut out, and how it hangs together with the others.
struct CutSubmesh {
  MeshState state;
  std::vector<VertexId> fixed;  // the number in the whole of each of the first `input_vertices` vertices
  std::vector<VertexId> own;    // the numbers in the whole of the vertices that it has alone, before it is worked on
  std::vector<CutEdge> edges;   // by a, then b
};

// Scratch of one thread: the local number of each vertex of the whole, kNone between calls.
using VertexNumbers = std::vector<VertexId>;

CutSubmesh cutOut(const MeshState& whole, const Partition& partition, PieceId piece, VertexNumbers& numbers);

}  // namespace coastmesh
