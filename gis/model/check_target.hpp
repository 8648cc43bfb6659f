#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "gis/grid/grid.hpp"
#include "gis/model/target.hpp"

namespace coastmesh {

// What makes a model refuse a grid.
enum class TargetDefectKind {
  WrongCount,      // a file says of itself what is not so
  BrokenEdge,      // an edge of three triangles, or of two that go round differently
  Clockwise,       // a triangle that goes clockwise, or has no area
  UnusedNode,      // a node of no triangle
  RepeatedNode,    // two nodes in one place
  HangingNode,     // a node on the edge of a triangle that is not its corner
  PinchedNode,     // the mesh touches itself in a node
  OrphanCell,      // a triangle without a neighbour
  UnknownDepth,    // a node without a depth
  DryOpening,      // a node of an opening that is above the water
  NoBoundary,      // an edge of the mesh's boundary that is in none
  StrayBoundary,   // two nodes of a boundary that follow one another with no edge of the mesh's boundary between
  BoundaryTwice,   // an edge of the mesh's boundary that is in two
  BoundaryTurned,  // a boundary with the mesh to its right
  LoopedBoundary,  // an open boundary, or the outer shore, that ends where it starts
  WrongShore,      // an outer shore that says it is an island, or the other way round
  TwoOpenEdges,    // a triangle with two open edges
  OpenAndSolid,    // a triangle with an open edge and a solid one
  OneNeighbour,    // a triangle with one neighbour alone
  LoneWall,        // a single solid edge between two openings, which codes at nodes cannot say
  Valence,         // an inner node with too few or too many triangles
  LargeAngle,      // an angle larger than the model takes
  NotOrthogonal,   // an edge that the line between the neighbours' centres crosses askew
  SmallFlowLink,   // an edge with the neighbours' centres too near to one another
  Courant,         // a triangle whose Courant number the time step puts out of range
};
inline constexpr std::size_t kTargetDefectKinds = 25;
std::string_view toString(TargetDefectKind kind);

struct TargetDefect {
  TargetDefectKind kind;
  Point place;                 // in the grid's CRS
  std::int64_t triangle = -1;  // index, -1 where none is meant
  std::int64_t node = -1;      // the same
  double value =
      0.0;  // degrees, metres above the water, triangles round a node, a cosine, a share (`FlowLink`), a Courant number
  std::string text;     // of WrongCount
  bool advice = false;  // the model runs all the same, but not as well as it could
};

struct TargetCheckOptions {
  double time_step_s = 0.0;  // seconds; 0: Courant numbers are not looked at
};

// Everything that makes the model refuse the grid, by kind, Courant numbers from the worst on (`timeSteps` says how
// they are measured); then what is advice. Boundaries are taken as they stand. The bounds are in target_limits.hpp.
std::vector<TargetDefect> checkTarget(const Grid& grid, Target target, const TargetCheckOptions& options = {});

// The same of the time step alone, whatever the model: triangles with a Courant number above 1, from the worst on.
std::vector<TargetDefect> checkTimeStep(const Grid& grid, double time_step_s);

// MPAS' measure: the largest angle in degrees of the flat triangle through three places of a sphere, latitudes as they
// are; of coordinates that are no longitudes and latitudes, as they stand.
double largestSphereAngle(const Crs& crs, const Point& a, const Point& b, const Point& c);

// SWAN's measure: the largest angle in degrees, of coordinates as they stand in the file. It takes longitudes and
// latitudes for a plane.
double largestFileAngle(const Point& a, const Point& b, const Point& c);

}  // namespace coastmesh
