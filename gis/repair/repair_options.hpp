#pragma once

#include <vector>

namespace coastmesh {

struct RepairOptions {
  // Seconds: triangles with a shorter time step (`timeSteps`) are repaired too; 0: not used.
  double time_step_s = 0.0;
  bool shore_moves = false;  // nodes of the shore may slide along it, and be removed
  // Degrees: the minimum angle of the mesh, which repairs should keep; 0: unknown.
  double min_angle_deg = 0.0;
  // Degrees: the maximum angle, which repairs for the time step keep: models may need what other repairs mend.
  double max_angle_deg = 180.0;
};

// What repairs learned about a grid, which saves later ones attempts that would fail again.
struct RepairMemory {
  std::vector<bool> stuck;  // for each triangle: nothing at its corners helps it to reach the time step
  std::vector<double> z;    // those of the nodes for which this is so
};

}  // namespace coastmesh
