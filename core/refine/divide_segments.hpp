#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/divided_segments.hpp"
#include "core/item_loop.hpp"
#include "core/pslg.hpp"
#include "core/refine/refine_options.hpp"
#include "core/refine/vertex_notes.hpp"
#include "core/size_function.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// A part of a segment between two vertices of a mesh.
struct Subsegment {
  VertexId a = kNone;
  VertexId b = kNone;
  SegmentId seg = kNone;
  EdgeRef edge = kNone;  // from a to b
};

// Those of a mesh that may be divided, by triangle.
std::vector<Subsegment> subsegmentsOf(const TriMesh& mesh, const Pslg& pslg, const ItemLoop& loop);

// A point that divides a subsegment, and the length requested there.
struct Division {
  Point at;
  double size;
};

struct Divided {
  std::vector<Division> divisions;
  bool is_whole = true;  // false if it ends early
};

// Divides subsegments evenly, by the requested lengths or, without them, into the fewest pieces no longer than the
// maximum edge.
class SegmentDivider {
 public:
  SegmentDivider(const Pslg& pslg, const RefineOptions& options)
      : pslg_(pslg), options_(options), longest_(options.size_max) {}

  // Divides part of a segment, from a to b. Ends early if there are clearly more than `most` divisions.
  Divided divide(const Point& a, const Point& b, SegmentId seg, std::uint64_t most) const;

 private:
  const Pslg& pslg_;
  const RefineOptions& options_;
  const ConstantSize longest_;
};

// Many subsegments are divided at the same time, this many by one thread; those with very many divisions one by one
// afterwards: otherwise all would be divided when there is no more room.
inline constexpr std::size_t kSubsegmentsAtOnce = 64;
inline constexpr std::uint64_t kManyDivisions = 250;

// The divisions that `splitSegments` would make of a mesh of the PSLG without Steiner points, for a triangulation of
// all vertices at once. Without pieces if more than `room` points are needed, or if rounding could make pieces touch.
DividedSegments divideSegments(const TriMesh& mesh, const Pslg& pslg, const VertexNotes& notes,
                               const RefineOptions& options, std::uint64_t room, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
