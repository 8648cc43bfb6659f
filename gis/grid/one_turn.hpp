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

// Whether two corners of a triangle are more than half a turn apart; a pole has no longitude.
bool longitudesJump(std::span<const Point> nodes, const std::array<std::uint32_t, 3>& corners);

// For models that take a difference of longitudes as it is: nodes in longitudes and latitudes, their longitudes in one
// turn, so that no triangle reaches from one end of them to the other. The turn begins at the western edge of the mesh,
// past the widest gap between its triangles, and its westernmost node keeps its longitude: 176 to 181.5 for a mesh from
// 176 to -178.5. Nodes move by whole turns; those that need not move keep their bits. Nothing if no edge of a triangle
// jumps, or if the mesh goes all round a pole or the globe: then some edge has to.
std::optional<std::vector<Point>> inOneTurn(std::span<const Point> nodes,
                                            std::span<const std::array<std::uint32_t, 3>> triangles,
                                            const ItemLoop& loop = inOrder);

// Puts the nodes of a grid into one turn, and those that may have been moved or added since back to where its
// longitudes were.
class TurnedNodes {
 public:
  // Changes nothing in a grid without longitudes, or one for which `inOneTurn` has nothing.
  explicit TurnedNodes(Grid& grid);

  bool any() const { return !was_.empty(); }
  void putBack(Grid& grid) const;
  Point putBack(const Point& place) const;  // a node that was not moved gets the bits that it had

 private:
  struct Turned {
    Point place;
    double was;
  };
  double west_ = 0.0;        // the least longitude before
  std::vector<Turned> was_;  // the nodes that were turned, by place
};

}  // namespace coastmesh
