#pragma once

#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// The time step that a grid leaves to an explicit model (Courant, Friedrichs and Lewy): a triangle's is its shortest
// edge over sqrt(g d), the speed of a long wave, d being the depth of its deepest corner. So no reading of the depth in
// a triangle, at its nodes or their mean, gives a shorter one. A time step over it is the triangle's Courant number.

// Seconds, one a triangle: infinite where no corner is under water, NaN where no depth is known.
std::vector<double> timeSteps(const Grid& grid);

// The shortest edge, and the triangle with the shortest time step.
struct StepReport {
  double shortest_edge_m = 0.0;                             // of a grid in a plane in its units
  Point shortest_edge;                                      // its middle, in the grid's CRS
  bool has_depths = false;                                  // else there is no time step
  double step_s = std::numeric_limits<double>::infinity();  // so where nothing is under water
  Point step_place;                                         // the middle of that triangle
};

StepReport measureStep(const Grid& grid, const ItemLoop& loop = inOrder);  // of a grid without triangles: as above

// What keeps edges short.
enum class ShortCause {
  Shore,     // an edge of the boundary, or of a line inside the mesh
  Narrow,    // an edge from shore to shore
  Interior,  // sizes or angles near by
};
inline constexpr std::size_t kShortCauses = 3;
std::string_view toString(ShortCause cause);

// A triangle whose Courant number is too large.
struct ShortStep {
  std::uint32_t triangle = 0;
  Point place;            // its middle
  double step_s = 0.0;    // with a Courant number of 1
  double needed_m = 0.0;  // of its edges
  ShortCause cause = ShortCause::Interior;
};

// Triangles whose Courant number at `time_step_s` is above `courant`, the worst first.
std::vector<ShortStep> stepsBelow(const Grid& grid, double time_step_s, double courant);

struct ShortEdge {
  Point place;  // its middle
  double length_m = 0.0;
  ShortCause cause = ShortCause::Interior;
};

// Edges shorter than `least_m`, the shortest first.
std::vector<ShortEdge> edgesBelow(const Grid& grid, double least_m);

}  // namespace coastmesh
