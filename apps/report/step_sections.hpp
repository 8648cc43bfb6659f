#pragma once

#include "apps/job/step_outcome.hpp"
#include "apps/report/report_sections.hpp"

namespace coastmesh {

// What reports say of a grid's shortest edge and time step; `outcomeSection` also whether they are what was asked for.
Json stepSection(const StepReport& step);
Json outcomeSection(const StepOutcome& outcome, const SizeOptions& sizes);

}  // namespace coastmesh
