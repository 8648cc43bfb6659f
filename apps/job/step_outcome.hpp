#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/refine/refine_options.hpp"
#include "gis/model/time_step.hpp"
#include "gis/repair/repair_report.hpp"
#include "gis/size/size_source.hpp"

namespace coastmesh {

// A finished grid's time step, and whether --time-step, --courant-min and --size-min are met in it.
struct StepOutcome {
  // Edges are mostly between 0.7 and 1.4 times the size, so that --size-min is undercut only by shorter ones; those
  // shorter than `kShareOfLeast` of it miss it.
  static constexpr double kUsualShare = 0.7, kShareOfLeast = 0.5;

  StepReport step;
  std::vector<ShortStep> below_step;   // triangles that miss --time-step, the worst first
  std::vector<LongStep> above_step;    // those that miss --courant-min, the worst first
  std::vector<ShortEdge> below_least;  // edges that undercut --size-min, the shortest first
  bool least_missed = false;           // one of them is far too short, and not because --coast keep preserves the data

  std::vector<std::string> notes, warnings;

  bool held() const { return below_step.empty() && above_step.empty() && !least_missed; }
};

// `goal` is that of the optimiser, which may have needed short edges. `small_waters` were left as in the input, as no
// element fits into them; `repairs` for models may have split edges.
StepOutcome measureOutcome(const Grid& grid, const SizeOptions& sizes, const ItemLoop& loop,
                           QualityGoal goal = QualityGoal::Shape, std::size_t small_waters = 0,
                           std::span<const Repair> repairs = {});

// A line for users: the shortest edge and the time step, with their places. `targets`: names of models; if none of them
// has long waves, their time step is left out.
std::string stepText(const StepReport& step, bool plane, const std::vector<std::string>& targets = {});

}  // namespace coastmesh
