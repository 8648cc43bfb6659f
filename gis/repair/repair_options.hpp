#pragma once

#include <vector>

namespace coastmesh {

struct RepairOptions {
  // Seconds: triangles that leave a shorter time step (`timeSteps`) are mended too; 0: none is asked for.
  double time_step_s = 0.0;
  bool shore_moves = false;  // nodes of the shore may move along it, and go
  // Degrees: what the mesh keeps, and repairs should; 0: nothing is known of it.
  double min_angle_deg = 0.0;
};

// What repairs found out about a grid, which spares the next of them attempts that would fail again.
struct RepairMemory {
  std::vector<bool> stuck;  // one a triangle: nothing at its corners helps it to the time step
  std::vector<double> z;    // the nodes', with which this is so
};

}  // namespace coastmesh
