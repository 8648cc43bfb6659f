#pragma once

#include <array>
#include <cstddef>
#include <memory>
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

// Per-thread scratch: the local number of each vertex of the whole mesh, kNone between calls. Memory is taken for the
// stretches of vertices that this thread's pieces have.
class VertexNumbers {
 public:
  void setVertices(std::size_t count) { stretches_.resize(count / kStretch + 1); }
  VertexId& operator[](VertexId v) {
    std::unique_ptr<Stretch>& stretch = stretches_[v / kStretch];
    if (stretch == nullptr) {
      stretch = std::make_unique<Stretch>();
      stretch->fill(kNone);
    }
    return (*stretch)[v % kStretch];
  }

 private:
  static constexpr std::size_t kStretch = 1024;
  using Stretch = std::array<VertexId, kStretch>;
  std::vector<std::unique_ptr<Stretch>> stretches_;
};

CutSubmesh cutOut(const MeshState& whole, const Partition& partition, PieceId piece, VertexNumbers& numbers);

}  // namespace coastmesh
