#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gis/repair/repair_options.hpp"
#include "gis/repair/repair_patch.hpp"
#include "gis/repair/repair_report.hpp"
#include "gis/repair/repair_shore.hpp"

namespace coastmesh {

// What the repairs of a grid work on.
struct RepairState {
  Grid& grid;
  std::span<const Target> targets;
  RepairOptions options{};
  RepairReport report{};
  GridLinks links{};
  // One a triangle, in this round: changed or looked at, and taken out.
  std::vector<bool> touched{}, dead{};
  mutable std::vector<double> smallest_angle{};   // as RepairView has it: thousands of triangles may share a node
  mutable std::vector<SphereVector> on_sphere{};  // the same
  std::vector<double> metres_per_unit{};          // as StepBound has it; of this round
  std::optional<ShoreIndex> shores{};             // where nodes of the shore may move; of this round
  // One a triangle, in all rounds: changed since it was measured.
  std::vector<bool> changed{};
  // One a triangle and one a node: tried to mend in vain. `disturbed` are triangles that have changed since, which
  // gives those round them another chance.
  std::vector<bool> hopeless_triangles{}, hopeless_nodes{}, disturbed{};
  // One a triangle: nothing at its corners helps it to the time step, as long as the triangles there stay as they are.
  std::vector<bool> stuck{};

  RepairView view() const {
    // A shore that stays as it is seldom lets the step hold everywhere: then angles are not given for it.
    const StepBound step{options.time_step_s, options.shore_moves ? 20.0 : options.min_angle_deg, metres_per_unit,
                         options.max_angle_deg};
    return {grid, links, targets, smallest_angle, on_sphere, step, shores ? &*shores : nullptr};
  }
  bool isTaken(std::uint32_t t) const { return touched[t] || dead[t]; }
  bool anyTaken(std::span<const std::uint32_t> triangles) const;
};

// A defect, and the model that minds it.
struct FoundDefect {
  std::optional<Target> target;  // none: the time step is missed, whatever the model
  TargetDefect defect;
};

void addRepair(RepairState& state, const FoundDefect& found, const Point& place, std::string what);

// The first of all rounds is yet to be started.
void startRepairs(RepairState& state, const RepairMemory* memory);
RepairMemory memoryOf(const RepairState& state);

// The kinds of the boundary's edges have to be known (`takeBoundaryKinds`).
void startRound(RepairState& state);

// Takes out dead triangles and nodes without triangles.
void compact(RepairState& state);

}  // namespace coastmesh
