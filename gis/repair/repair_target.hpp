#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/item_loop.hpp"
#include "core/run_control.hpp"
#include "gis/check/check_target.hpp"
#include "gis/grid/grid.hpp"
#include "gis/repair/repair_options.hpp"
#include "gis/repair/repair_report.hpp"

namespace coastmesh {

// Repairs the defects that `checkTarget` finds for the models, in rounds, changing as little of the grid as possible:
// nodes where the mesh touches itself are duplicated and moved apart, triangles without a neighbour, copies of
// triangles and unused nodes removed, clockwise triangles turned, dry nodes of open boundaries lowered. If a triangle,
// a node or a flow link violates a limit of a model, edges are flipped or split, or nodes moved that no boundary, line
// or feature holds; a corner of the boundary too sharp for two triangles is cut off if FVCOM needs them there, and so
// is one that no other edit repairs. With `shore_moves`, nodes also move along shores and along straight parts of
// openings, and shores may lose corners for FESOM2. Boundaries are rebuilt; new depths interpolated. If triangles allow
// too short a time step, edges are lengthened or collapsed. Of edits that repair a defect, the one with the larger
// angles is chosen; if angles end up below `min_angle_deg`, the nodes around them are adjusted. Angles and areas of
// changed triangles are measured again. Longitudes that jump are unwrapped during repairs, and restored at the end.
// Throws InputError if the grid has weirs and defects other than wrong counts, or if no triangle is left. `memory`
// comes from the last call with the same options, on the grid that it left, whose depths may have changed since. It is
// updated. A round that repairs less than a thousandth of the defects is the last. Throws Cancelled.
RepairReport repairForTargets(Grid& grid, std::span<const Target> targets, const RepairOptions& options = {},
                              RepairMemory* memory = nullptr, const RunControl& control = {},
                              const ItemLoop& loop = inOrder);

}  // namespace coastmesh
