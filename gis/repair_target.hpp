#pragma once

#include <span>
#include <string>
#include <vector>

#include "gis/check_target.hpp"
#include "gis/grid.hpp"

namespace coastmesh {

// One thing that was done to a grid for a model.
struct Repair {
  TargetDefectKind kind;  // of the defect
  Target target;          // the model that minds it
  Point place;            // in the grid's CRS
  std::string what;       // "node doubled, and moved apart by 12.5 m"
};

struct RepairReport {
  std::vector<Repair> repairs;
  std::vector<std::pair<Target, TargetDefect>> left;  // what could not be mended
};

// Changes as little of the grid as takes away what `checkTarget` finds for the models, in rounds: nodes in which the
// mesh touches itself are doubled and moved apart, triangles without a neighbour and unused nodes taken out, clockwise
// triangles turned, edges flipped or split, or nodes moved that no boundary, line or feature holds, where a triangle, a
// node or a flow link is not as a model wants it, and boundaries put together anew. Depths of new and moved nodes lie
// between those of the nodes there were. Angles and areas of what was changed are measured again. Throws InputError for a
// grid with weirs that has defects.
RepairReport repairForTargets(Grid& grid, std::span<const Target> targets);

}  // namespace coastmesh
