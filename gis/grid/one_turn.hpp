#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "core/point.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// True if longitudes of two corners differ by more than half a turn; a pole has no longitude.
bool longitudesJump(std::span<const Point> nodes, const std::array<std::uint32_t, 3>& corners);

// Unwraps longitudes, for models that use differences of longitudes as they are: returns nodes with longitudes within
// one turn, so that no triangle spans a jump. The turn begins at the western edge of the mesh, past the widest gap
// between its triangles, and its westernmost node keeps its longitude, unless that leads past 540: 176 to 181.5 for a
// mesh from 176 to -178.5. Nodes move by whole turns; those that need not move keep their bits. Returns nullopt if no
// edge of a triangle jumps, or if the mesh surrounds a pole or the globe, so that some edge has to.
std::optional<std::vector<Point>> inOneTurn(std::span<const Point> nodes,
                                            std::span<const std::array<std::uint32_t, 3>> triangles,
                                            const ItemLoop& loop = inOrder);

// Unwraps the longitudes of a grid, and restores their range later, also for nodes moved or added in between.
class TurnedNodes {
 public:
  // Changes nothing in a grid without longitudes, or one for which `inOneTurn` returns nullopt.
  explicit TurnedNodes(Grid& grid, const ItemLoop& loop = inOrder);

  bool any() const { return !was_.empty(); }
  void putBack(Grid& grid) const;
  Point putBack(const Point& place) const;  // a node that has not moved since gets its old bits

 private:
  struct Turned {
    Point place;
    double was;
  };
  double west_ = 0.0;        // the western end of the old range of longitudes
  std::vector<Turned> was_;  // the unwrapped nodes, by place
};

}  // namespace coastmesh
