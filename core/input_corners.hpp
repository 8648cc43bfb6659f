#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/box_halves.hpp"
#include "core/item_loop.hpp"
#include "core/metric.hpp"
#include "core/tri_mesh.hpp"

namespace coastmesh {

// An input vertex with two adjacent constraints that enclose a part of the domain, at an angle below 180 degrees that
// cannot be divided within the bounds: some triangle at the apex has to miss them.
struct InputCorner {
  Point apex;
  Point right, left;  // other ends of the constraints; the corner is to the left of the direction to `right`
  double radius;      // kNearShare of the local feature size at the apex
};

// Radius around the apex, in local feature sizes, within which a corner excuses triangles that do not fill it. One
// local feature size contains only what meets at the apex, so nothing else can be the cause. No triangle of the coasts
// in data/ needs this up to 42 degrees; with fans of tiny angles most that do are within a quarter.
inline constexpr double kNearShare = 1.0 + 1e-9;  // shells end at exactly that size, up to rounding

// The reason why a triangle may miss the bounds.
enum class Excuse : std::uint8_t {
  None,
  Corner,  // it has a corner's apex as a vertex, and lies in the corner
  Near,    // its three vertices are within the radius of a corner
};

// The number of triangles that miss the bounds, and of those that are excused, by reason.
struct BoundCounts {
  std::uint64_t below = 0;   // all that miss them
  std::uint64_t corner = 0;  // excused by Excuse::Corner
  std::uint64_t near = 0;    // excused by Excuse::Near

  std::uint64_t excused() const { return corner + near; }
  std::uint64_t unresolved() const { return below - excused(); }
  // Counts one more triangle.
  void add(Excuse excuse);
  void add(const BoundCounts& other);
};

// The corners of a mesh's input. They depend on the input alone, not on where refinement put points. The local feature
// size of an apex is the distance to the nearest input vertex or constraint that does not meet it, through the domain
// or not; of constraints that meet it the other end counts. Input outside the domain is not in the mesh, and does not
// count. Constraints are the input's segments, as a whole. For a mesh read from a file (`input_vertices` 0) the input
// is unknown: there a constraint is a chain of edges, on the boundary or with a segment, up to where it bends,
// branches, or changes its segment; input vertices in the middle of a straight chain, or on none, cannot be recognised
// and do not count.
class InputCorners {
 public:
  InputCorners() = default;
  // Cheap if there are none.
  InputCorners(const TriMesh& mesh, const TriangleBound& bound, const ItemLoop& loop = inOrder);
  // From the list returned by `all` of another instance.
  explicit InputCorners(std::vector<InputCorner>&& corners);

  std::span<const InputCorner> all() const { return corners_; }
  // The reason that excuses triangle abc, which misses the bounds.
  Excuse excuseOf(const Point& a, const Point& b, const Point& c) const;

 private:
  std::vector<InputCorner> corners_;
  BoxHalves disks_;
};

}  // namespace coastmesh
