#pragma once

#include "apps/job/step_outcome.hpp"
#include "apps/report/report_sections.hpp"

namespace coastmesh {

// Sections of reports on a grid's shortest edge and time step; `outcomeSection` adds whether requirements are met.
Json stepSection(const StepReport& step);
Json outcomeSection(const StepOutcome& outcome, const SizeOptions& sizes);

}  // namespace coastmesh
