#pragma once

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
};

// Declares the options on the size of elements; `sizes` and `usage` must outlive the parsing.
void declareSizing(OptionTable& table, SizeOptions& sizes, SizingUsage& usage);

// To be called once parsed. `depths`: where sizes find depths. `may_choose`: if no sizes are requested, sizes for a sea
// model are chosen. Throws OptionError for options that cannot be combined.
void settleSizing(const SizingUsage& usage, const DepthOptions& depths, bool may_choose, SizeOptions& sizes);

// A note for each requested size, or growth of sizes, that a bound on all sizes overrides.
std::vector<std::string> notesOnOverriddenSizes(const SizingUsage& usage, const SizeOptions& sizes);

}  // namespace coastmesh
