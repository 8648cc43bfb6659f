#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/point.hpp"
#include "gis/check/check_target.hpp"

namespace coastmesh {

// One repair of a grid for a model.
struct Repair {
  TargetDefectKind kind;         // of the defect
  std::optional<Target> target;  // the model that rejects it; nullopt: the time step is missed, for any model
  Point place;                   // in the grid's CRS
  std::string what;              // "node duplicated and moved apart by 12.5 m"
  bool splits_edge = false;      // a new node divides an edge: both parts are shorter
};

struct RepairReport {
  std::vector<Repair> repairs;
  std::vector<std::pair<Target, TargetDefect>> left;  // what could not be repaired
};

}  // namespace coastmesh
