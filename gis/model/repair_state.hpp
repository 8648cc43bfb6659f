#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gis/model/repair_patch.hpp"
#include "gis/model/repair_report.hpp"

namespace coastmesh {

// What the repairs of a grid work on.
struct RepairState {
  Grid& grid;
  std::span<const Target> targets;
  RepairReport report{};
  GridLinks links{};
  // One a triangle, in this round: changed or looked at, and taken out.
  std::vector<bool> touched{}, dead{};
  mutable std::vector<double> smallest_angle{};  // as RepairView has it: thousands of triangles may share a node
  // One a triangle, in all rounds: changed since it was measured.
  std::vector<bool> changed{};
  // One a triangle and one a node: tried to mend in vain. `disturbed` are triangles that have changed since, which
  // gives those round them another chance.
  std::vector<bool> hopeless_triangles{}, hopeless_nodes{}, disturbed{};

  RepairView view() const { return {grid, links, targets, smallest_angle}; }
  bool isTaken(std::uint32_t t) const { return touched[t] || dead[t]; }
  bool anyTaken(std::span<const std::uint32_t> triangles) const;
};

// A defect, and the model that minds it.
struct FoundDefect {
  Target target;
  TargetDefect defect;
};

void addRepair(RepairState& state, const FoundDefect& found, const Point& place, std::string what);

// The kinds of the boundary's edges have to be known (`takeBoundaryKinds`).
void startRound(RepairState& state);

// Takes out dead triangles and nodes without triangles.
void compact(RepairState& state);

}  // namespace coastmesh
