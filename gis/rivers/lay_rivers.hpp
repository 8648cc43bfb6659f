#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/item_loop.hpp"
#include "core/refine/refine_options.hpp"
#include "core/run_control.hpp"
#include "gis/grid/grid.hpp"
#include "gis/rivers/river_grid.hpp"
#include "gis/rivers/river_lines.hpp"

namespace coastmesh {

// Which parts of rivers get rows.
enum class RiverExtent {
  Outside,  // where the mesh has no water, and one row into it
  All,      // in the water of the mesh too
};

struct RiverOptions {
  std::size_t cells = 2;                                               // across each river, at least
  double most_cell_width_m = std::numeric_limits<double>::infinity();  // wider rivers get more cells
  double aspect = 3.0;                                                 // length of a cell over its width
  RiverExtent extent = RiverExtent::Outside;
  // Rivers that end this close to the water are continued to it; infinite: see `connectRivers`.
  double reach_m = std::numeric_limits<double>::infinity();
  RefineOptions junctions{};  // bounds on the triangles at junctions
  double most_quads = 1e8;    // for which there is memory
};

// Why a river, or a part of one, has no rows.
enum class RiverLoss {
  Apart,    // it is not connected with the mesh
  InWater,  // the mesh has water there already
  Crowded,  // others leave it no room
  Within,   // it is within a wider one, or given twice
  Short     // it is shorter than a row
};

struct LostRiver {
  RiverLoss why = RiverLoss::Apart;
  std::string name;       // of the line, else what it is
  Point place;            // in the mesh's CRS
  double distance = 0.0;  // from the mesh, for those apart: metres
};

struct RiverReport {
  std::size_t quads = 0, triangles = 0, junctions = 0, reaches = 0;
  std::size_t inflows = 0;       // ends outside the mesh
  std::vector<Point> extended;   // ends that were continued to the water of the mesh
  std::vector<Point> left;       // those as close that were not, since the river has another way to it
  std::vector<Point> led_out;    // ends on land that were continued past the mesh's edge
  std::vector<LandEnd> on_land;  // ends within the mesh's land, which are no inflows
  double moved_m = 0.0;          // the farthest that a centre line was moved in a turn that was too sharp for its width
  Point moved_place;             // near it
  std::size_t narrowed = 0;      // reaches that come closer to themselves than their width, and are narrower there
  Point narrowed_place;          // the last of these places
  std::size_t below = 0;         // triangles at junctions that miss the bound on angles
  double least_angle_deg = 180.0;  // of them
  Point least_place;
  std::vector<LostRiver> lost;
};

struct LaidRivers {
  // Quadrilaterals, and triangles at junctions, in the mesh's CRS. Ends outside the mesh are river boundaries; what may
  // join the mesh is open, all else is land. Depths are those of lines, unknown where none is given.
  Grid grid;
  std::vector<double> mesh_z;  // z of the mesh at each node; NaN where it has none
  RiverReport report;
};

// Makes rows of quadrilaterals along centre lines, to be put into `mesh`, which is not changed. The grid is empty if
// all rivers are lost. Throws InputError for a line that has no length or cannot be projected, and for too many
// quadrilaterals; Cancelled.
LaidRivers layRivers(const std::vector<RiverLine>& lines, const Grid& mesh, const RiverOptions& options,
                     const RunControl& control = {}, const ItemLoop& loop = inOrder);

}  // namespace coastmesh
