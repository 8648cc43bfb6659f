#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/usage/option_table.hpp"
#include "gis/model/depth.hpp"
#include "gis/size/size_source.hpp"

namespace coastmesh {

// Which options on sizes were given, if their values do not show it.
struct SizingUsage {
  bool filter_given = false;
  bool coast_given = false;
  bool grade_given = false;
  bool shore_rate_given = false;
  bool time_step_given = false;
};

// Declares the options on the size of elements; `sizes` and `usage` must outlive the parsing. `chooses` returns true
// once parsed if sizes are to be chosen: options that need sizes then have an effect.
void declareSizing(OptionTable& table, SizeOptions& sizes, SizingUsage& usage, const std::function<bool()>& chooses);

// To be called once parsed. `depths`: where sizes find depths. `choose`: sizes for a sea model are to be chosen. Throws
// OptionError for options that cannot be combined.
void settleSizing(const SizingUsage& usage, const DepthOptions& depths, bool choose, SizeOptions& sizes);

// A note for each requested size, or growth of sizes, that a bound on all sizes overrides.
std::vector<std::string> notesOnOverriddenSizes(const SizingUsage& usage, const SizeOptions& sizes);

}  // namespace coastmesh
