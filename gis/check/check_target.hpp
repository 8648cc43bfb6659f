#pragma once

#include <vector>

#include "core/item_loop.hpp"
#include "gis/check/target_defect.hpp"
#include "gis/grid/grid.hpp"
#include "gis/grid/linked_grid.hpp"
#include "gis/model/target.hpp"

namespace coastmesh {

struct TargetCheckOptions {
  double time_step_s = 0.0;  // seconds; 0: Courant numbers are not checked
  bool overlaps = true;      // look for triangles that overlap
};

// True if the model has limits for Courant numbers of long waves. SWAN computes none; FESOM2 and MPAS-Ocean step these
// waves separately.
bool isOfLongWaves(Target target);

// All defects that make the model reject the grid, by kind, Courant numbers starting with the worst (measured as in
// `timeSteps`); then advice. Boundaries are taken as they are. The limits are in target_limits.hpp.
std::vector<TargetDefect> checkTarget(const Grid& grid, Target target, const TargetCheckOptions& options = {},
                                      const ItemLoop& loop = inOrder);

// The same for a grid that is linked already.
std::vector<TargetDefect> checkTarget(const Grid& grid, const LinkedGrid& linked, Target target,
                                      const TargetCheckOptions& options = {}, const ItemLoop& loop = inOrder);

// The same for the time step alone, for any model: triangles with a Courant number above 1, starting with the worst.
std::vector<TargetDefect> checkTimeStep(const Grid& grid, double time_step_s, const ItemLoop& loop = inOrder);

// MPAS' measure: the largest angle in degrees of the flat triangle through three points of a sphere, from longitudes
// and unchanged latitudes.
double largestSphereAngle(const Point& a, const Point& b, const Point& c);

// True if MPAS' file has other places than a grid in this CRS: on its sphere, not in a projected CRS.
bool isProjectedForMpas(const Crs& crs);

// SWAN's measure: the largest angle in degrees, from coordinates as they are in the file. It treats longitudes and
// latitudes as a plane.
double largestFileAngle(const Point& a, const Point& b, const Point& c);

}  // namespace coastmesh
