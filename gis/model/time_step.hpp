#pragma once

#include <cstdint>
#include <limits>
#include <string_view>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

// The longest time step of an explicit model on a grid (Courant, Friedrichs and Lewy): for a triangle its shortest edge
// over sqrt(g d), the speed of a long wave, with d the depth of its deepest corner, so that no definition of a
// triangle's depth gives a shorter one. The Courant number of a triangle is the model's time step over this.

// Metres: the depth of the triangle's deepest corner; NaN if none is known.
double deepestOf(const Grid& grid, std::uint32_t t);

// Seconds, for each triangle: infinite if no corner is under water, NaN if no depth is known.
std::vector<double> timeSteps(const Grid& grid, const ItemLoop& loop = inOrder);

// The shortest edge, and the triangle with the shortest time step.
struct StepReport {
  double shortest_edge_m = 0.0;                             // for a grid in a plane in its units
  Point shortest_edge;                                      // its middle, in the grid's CRS
  bool has_depths = false;                                  // otherwise there is no time step
  double step_s = std::numeric_limits<double>::infinity();  // infinite if nothing is under water
  Point step_place;                                         // the middle of that triangle
  // On a grid with a flood plain, the same with the water as high as 95 % of its nodes: metres above the still water; 0
  // on other grids.
  double flood_m = 0.0;
  double flooded_step_s = std::numeric_limits<double>::infinity();
  Point flooded_place;
};

StepReport measureStep(const Grid& grid, const ItemLoop& loop = inOrder);  // the defaults for a grid without triangles

// The reason why an edge is short.
enum class ShortCause {
  Shore,     // an edge of the shore
  Opening,   // an edge of an open boundary or a river
  Narrow,    // an edge from shore to shore
  Line,      // an edge of a line inside the mesh, or one that ends at it
  Interior,  // sizes or angles nearby
};
inline constexpr std::size_t kShortCauses = 5;
std::string_view toString(ShortCause cause);

// A triangle whose Courant number is too large.
struct ShortStep {
  std::uint32_t triangle = 0;
  Point place;            // its middle
  double step_s = 0.0;    // for a Courant number of 1
  double needed_m = 0.0;  // the length that its shortest edge needs
  ShortCause cause = ShortCause::Interior;
};

// Triangles whose Courant number at `time_step_s` is above `courant`, the worst first.
std::vector<ShortStep> stepsBelow(const Grid& grid, double time_step_s, double courant, const ItemLoop& loop = inOrder);

// A triangle whose Courant number is too small.
struct LongStep {
  std::uint32_t triangle = 0;
  double step_s = 0.0;  // for a Courant number of 1
};

// Triangles in water of `least_depth_m` and more whose Courant number at `time_step_s` is below `courant`, the worst
// first.
std::vector<LongStep> stepsAbove(const Grid& grid, double time_step_s, double courant, double least_depth_m,
                                 const ItemLoop& loop = inOrder);

struct ShortEdge {
  Point place;  // its middle
  double length_m = 0.0;
  ShortCause cause = ShortCause::Interior;
};

// Edges shorter than `least_m`, the shortest first.
std::vector<ShortEdge> edgesBelow(const Grid& grid, double least_m, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
