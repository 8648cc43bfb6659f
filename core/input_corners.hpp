#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/box_halves.hpp"
#include "core/item_loop.hpp"
#include "core/metric.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// An input vertex and two constraints next to one another there, domain between them, at an angle below half a
// turn that cannot be divided within the bounds: some triangle at the apex has to break them.
struct InputCorner {
  Point apex;
  Point right, left;  // the other ends of the constraints; the corner lies to the left of the way to `right`
  double radius;      // kNearShare of the local feature size at the apex
};

// How far from the apex a corner excuses other triangles than those that fill it, in local feature sizes. Within one of
// them there is nothing but what meets at the apex, so that nothing else can be to blame. No triangle of the coasts in
// data/ needs it at up to 42 degrees; at fans of tiny angles most that do lie within a quarter.
inline constexpr double kNearShare = 1.0 + 1e-9;  // shells end at the very size, but for rounding

// What excuses a triangle that breaks the bounds.
enum class Excuse : std::uint8_t {
  None,
  Corner,  // it has a corner's apex as a vertex, and lies in the corner
  Near,    // its three vertices lie within the radius of a corner
};

// How many triangles break the bounds, and how many of them what excuses.
struct BoundCounts {
  std::uint64_t below = 0;   // all that break them
  std::uint64_t corner = 0;  // of them, by Excuse::Corner
  std::uint64_t near = 0;    // and by Excuse::Near

  std::uint64_t excused() const { return corner + near; }
  std::uint64_t unresolved() const { return below - excused(); }
  // One more triangle.
  void add(Excuse excuse);
  void add(const BoundCounts& other);
};

// The corners of a mesh's input, found from that input alone: where refinement put points does not matter. The local
// feature size of an apex is the distance to the nearest input vertex or constraint that does not meet it, through the
// domain or not; of constraints that meet it the other end counts. What lies off the domain is not in the mesh, and
// does not count. Constraints are the input's segments, whole. Of a mesh that was read from a file (`input_vertices` 0)
// the input is not known: there a constraint is a chain of edges, on the boundary or with a segment, up to where they
// bend, part, or change their segment; an input vertex in the middle of a straight chain, or on none, cannot be told
// from others and does not count.
class InputCorners {
 public:
  InputCorners() = default;
  // Costs next to nothing where there are none.
  InputCorners(const TriMesh& mesh, const TriangleBound& bound, const ItemLoop& loop = inOrder);
  // As `all` of another gave them.
  explicit InputCorners(std::vector<InputCorner>&& corners);

  std::span<const InputCorner> all() const { return corners_; }
  // What excuses the triangle abc where it breaks the bounds.
  Excuse excuseOf(const Point& a, const Point& b, const Point& c) const;

 private:
  std::vector<InputCorner> corners_;
  BoxHalves disks_;
};

}  // namespace coastmesh
