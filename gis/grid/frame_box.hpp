#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "core/pslg.hpp"
#include "core/tri_mesh.hpp"
#include "gis/coast/coastline.hpp"
#include "gis/geometry/box.hpp"
#include "gis/grid/grid.hpp"
#include "gis/projection/projection.hpp"

namespace coastmesh {

// The box of a frame. REQUIRES: `framed_by_box`.
class FrameBox {
 public:
  explicit FrameBox(const Coastline& coastline);

  // The point of the box that is nearest; if the box crosses the end of the longitudes, only latitudes are clamped.
  Point nearest(const Point& p) const;
  bool hasOnSide(const Point& p) const;
  // A place a little inside, opposite to where `nearest` takes points to `p` from. REQUIRES: on a side.
  Point inwards(const Point& p) const;

 private:
  Box box_;
  bool in_parts_;  // at both ends of the longitudes
};

// Bounds on angles, degrees.
struct AngleBounds {
  double least, greatest;
};

// Nodes that were moved, and the angles of their triangles, degrees.
struct FrameMoves {
  std::size_t nodes = 0;
  std::vector<std::array<double, 3>> angles_before, angles_after;
};

// Moves nodes outside the box of a frame onto it: a parallel consists of straight pieces in the working plane, which
// bulge towards the pole if elements are large. Areas and angles of their triangles are computed again. Does nothing if
// the frame is not a box; if it crosses the end of the longitudes, only latitudes are clamped. A node stays where it is
// if its move would invert a triangle, or make one break a bound that it met, or miss it by more.
FrameMoves keepInFrame(Grid& grid, const Coastline& coastline, const AngleBounds& bounds,
                       const ItemLoop& loop = inOrder);

// Undoes these moves in the plane, for a mesh whose points are at `nodes` in a file: those on a side of the box go to
// where segments of the input, of the frame or of a shore, pass beside it. `vertex_of` has the input's vertex at each
// point, or kNone; vertices stay. Returns 1 for each point on a side that is on no segment, as its place before is
// unknown; 0 for all others.
std::vector<std::uint8_t> undoMovesToFrame(TriMesh& mesh, std::span<const Point> nodes, const FrameBox& box,
                                           const Pslg& pslg, std::span<const VertexId> vertex_of,
                                           const Projection& projection);

}  // namespace coastmesh
