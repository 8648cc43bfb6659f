#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gis/crs/crs_map.hpp"
#include "gis/repair/repair_options.hpp"
#include "gis/repair/repair_patch.hpp"
#include "gis/repair/repair_report.hpp"
#include "gis/repair/repair_shore.hpp"

namespace coastmesh {

// The state that the repairs of a grid share.
struct RepairState {
  Grid& grid;
  std::span<const Target> targets;
  RepairOptions options{};
  ItemLoop loop = inOrder;
  RepairReport report{};
  GridLinks links{};
  // By triangle, in this round: `touched` has changed, or is in the patch of an edit; `dead` is removed.
  std::vector<bool> touched{}, dead{};
  mutable std::vector<double> smallest_angle{};  // as in RepairView, cached: a node may have thousands of triangles
  mutable std::vector<SphereVector> in_space{};  // likewise
  std::optional<CrsMap> to_earth{};              // as in RepairView; in all rounds
  mutable std::vector<Point> on_earth{};         // likewise; of this round
  std::vector<double> metres_per_unit{};         // as in StepBound; of this round
  std::optional<ShoreIndex> shores{};            // set if nodes of the shore may move; of this round
  // By triangle, in all rounds: changed since it was measured.
  std::vector<bool> changed{};
  // By triangle, and by node: a repair has failed. `disturbed` triangles have changed since: attempts near them are
  // repeated.
  std::vector<bool> hopeless_triangles{}, hopeless_nodes{}, disturbed{};
  // By triangle: the same for advice, which is tried in fewer ways.
  std::vector<bool> hopeless_advice{};
  // By triangle: no edit at its corners lets it reach the time step, as long as the triangles there do not change.
  std::vector<bool> stuck{};

  EarthShape shape() const { return options.on_sphere ? EarthShape::Sphere : EarthShape::Ellipsoid; }
  RepairView view() const {
    // With a fixed shore the time step can seldom be reached everywhere, so no angles are sacrificed for it.
    const StepBound step{options.time_step_s, options.shore_moves ? 20.0 : options.min_angle_deg, metres_per_unit,
                         options.max_angle_deg, options.least_edge_m};
    return {grid,
            links,
            targets,
            smallest_angle,
            in_space,
            step,
            shores ? &*shores : nullptr,
            shape(),
            to_earth ? &*to_earth : nullptr,
            on_earth};
  }
  bool isTaken(std::uint32_t t) const { return touched[t] || dead[t]; }
  bool anyTaken(std::span<const std::uint32_t> triangles) const;
};

// A defect, and the model that rejects it.
struct FoundDefect {
  std::optional<Target> target;  // nullopt: the time step is missed, for any model
  TargetDefect defect;
};

void addRepair(RepairState& state, const FoundDefect& found, const Point& place, std::string what,
               bool splits_edge = false);

// Call before the first round.
void startRepairs(RepairState& state, const RepairMemory* memory);
RepairMemory memoryOf(const RepairState& state);

// `mesh` is the grid's, linked. Repairs for the time step alone do not use it: it may be empty if there are no targets.
// REQUIRES: `links.kinds` is set (`takeBoundaryKinds`).
void startRound(RepairState& state, TriMesh mesh);
// The same, and links the grid if necessary.
void startRound(RepairState& state);

// Removes dead triangles, and nodes without triangles.
void compact(RepairState& state);

}  // namespace coastmesh
