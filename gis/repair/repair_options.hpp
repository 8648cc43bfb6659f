#pragma once

#include <vector>

#include "core/point.hpp"

namespace coastmesh {

struct RepairOptions {
  // Seconds: triangles with a shorter time step (`timeSteps`) are repaired too; 0: none.
  double time_step_s = 0.0;
  // Nodes of the shore, and of straight parts of openings, may slide along them, and be removed; those where the two
  // meet slide along the opening.
  bool shore_moves = false;
  // Degrees: the minimum angle of the mesh, which repairs should keep; 0: unknown.
  double min_angle_deg = 0.0;
  // Degrees: the maximum angle of the mesh. Repairs for the time step, and the final increase of small angles, keep it;
  // other repairs may exceed it, since models may need them.
  double max_angle_deg = 180.0;
  // Metres: repairs make shorter edges only where nothing else helps, or leaves angles below 20 degrees; 0: any length
  // will do.
  double least_edge_m = 0.0;
  std::vector<Point> asked{};  // places of nodes that the user requested: no repair moves them
  bool on_sphere = false;      // angles are those on a sphere with unchanged latitudes, not on the ellipsoid
};

// Failed attempts of earlier repairs of a grid, which later ones skip.
struct RepairMemory {
  std::vector<bool> stuck;  // for each triangle: no edit at its corners lets it reach the time step
  std::vector<double> z;    // the grid's, when `stuck` was determined
};

}  // namespace coastmesh
