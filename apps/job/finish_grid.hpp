#pragma once

#include <string>
#include <vector>

#include "core/item_loop.hpp"
#include "core/run_control.hpp"
#include "gis/flood_plain/dry_sides.hpp"
#include "gis/flood_plain/low_land.hpp"
#include "gis/grid/grid.hpp"
#include "gis/model/apart_waters.hpp"
#include "gis/model/assign_boundaries.hpp"
#include "gis/model/depth.hpp"
#include "gis/model/set_fields.hpp"
#include "gis/repair/repair_target.hpp"
#include "gis/weirs/beds_at_weirs.hpp"
#include "gis/weirs/raster_crests.hpp"
#include "gis/weirs/weir_crests.hpp"
#include "gis/weirs/weir_report.hpp"

namespace coastmesh {

// What is done to a mesh before it is written: depths, boundaries, repairs for models.
struct FinishOptions {
  DepthOptions depth{};
  std::vector<FieldSource> fields{};  // nodal attributes; interpolated and filled as depths are
  BoundaryOptions boundaries{};
  std::vector<std::string> targets{};  // names of models that the grid is repaired for
  RepairOptions repair{};
  bool drop_apart = false;  // waters without a connection to an open boundary are removed, if there is one
  GrazedWaters grazed = GrazedWaters::Drop;
  // With depths, parts of open boundaries across dry land become land first; see `closeDrySides`.
  bool close_dry = false;
  const PlainLand* plain = nullptr;  // tells the land of a flood plain from the water; null: the mesh has none
  std::vector<WeirSource> weirs{};   // those of the lines in the mesh; ADCIRC gets boundaries of them
  CrestRasters crests{};             // terrain at weirs without a height of their own

  bool any() const {
    return !depth.files.empty() || !fields.empty() || boundaries.any() || !targets.empty() || repair.time_step_s > 0.0;
  }
  // True if nodes and triangles may change.
  bool mayEdit() const { return !targets.empty() || repair.time_step_s > 0.0 || drop_apart; }
};

// The water that repairs have taken out, as triangles without a neighbour: what they added elsewhere is subtracted.
struct RepairLoss {
  double area_m2 = 0.0, share = 0.0;  // and its share of all water before
  bool in_plane = false;              // the area is in units of the plane
};

struct FinishReport {
  DepthReport depth;
  DrySides dry;
  LowLand low;              // of the flood plain
  bool starts_dry = false;  // an attribute was made of it
  std::vector<FieldReport> fields;
  BoundaryReport boundaries;
  bool mended = false;  // repairs were requested
  RepairReport repairs;
  RepairLoss lost;
  DroppedWaters dropped;
  std::size_t apart = 0;  // such waters that are left, if targets are given
  RasterCrests crests;
  WeirReport weirs;
  WeirBeds beds;                  // at weirs, for ADCIRC
  std::vector<Point> lost_asked;  // places of `RepairOptions::asked` that were nodes before, and are not now

  std::vector<std::string> notes() const;
  std::vector<std::string> warnings() const;
};

// Throws OptionError, InputError, Cancelled.
FinishReport finishGrid(Grid& grid, const FinishOptions& options, const RunControl& control = {},
                        const ItemLoop& loop = inOrder);

// For users: a line for each thing done; empty if nothing was requested.
std::string finishSummary(const FinishOptions& options, const FinishReport& report);

// Sections of the report as JSON text; "depth" and "repairs" are null if they were not requested.
std::string fieldSection(const FinishReport& report);
std::string depthSection(const FinishOptions& options, const FinishReport& report);
std::string repairSection(const FinishReport& report);
std::string boundarySection(const FinishOptions& options, const FinishReport& report, const Grid& grid);

}  // namespace coastmesh
