#pragma once

#include <span>
#include <string>
#include <vector>

#include "gis/grid/grid.hpp"
#include "gis/model/check_target.hpp"
#include "gis/repair/repair_options.hpp"
#include "gis/repair/repair_report.hpp"

namespace coastmesh {

// Changes as little of the grid as takes away what `checkTarget` finds for the models, in rounds: nodes in which the
// mesh touches itself are doubled and moved apart, triangles without a neighbour and unused nodes taken out, clockwise
// triangles turned, edges flipped or split, or nodes moved that no boundary, line or feature holds, where a triangle, a
// node or a flow link is not as a model wants it, and boundaries put together anew. Depths of new and moved nodes lie
// between those of the nodes there were. Where triangles leave too short a time step, edges are made longer or
// collapsed. Of edits that mend, that which leaves the larger angles is taken; where angles are smaller than the mesh
// keeps afterwards, nodes around give way. Angles and areas of what was changed are measured again. Where longitudes
// jump they are put into one turn, and back in the end. Throws InputError for a grid with weirs that has defects.
// `memory` is of the last call with these options, and of the grid that this left, the nodes of which may have other
// depths by now; it becomes that of this call.
RepairReport repairForTargets(Grid& grid, std::span<const Target> targets, const RepairOptions& options = {},
                              RepairMemory* memory = nullptr);

}  // namespace coastmesh
