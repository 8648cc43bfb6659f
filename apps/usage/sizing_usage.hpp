#pragma once

#include <string>
#include <vector>

#include "apps/usage/option_table.hpp"
#include "gis/model/depth.hpp"
#include "gis/size/size_source.hpp"

namespace coastmesh {

// What of the sizes was given, where it is not seen from their values.
struct SizingUsage {
  bool filter_given = false;
  bool coast_given = false;
  bool grade_given = false;
  bool shore_rate_given = false;
};

// Declares the options that say how large elements should be; `sizes` and `usage` must outlive the parsing.
void declareSizing(OptionTable& table, SizeOptions& sizes, SizingUsage& usage);

// Once parsed: `depths` are where sizes find theirs. A sea for a model, `may_choose`, gets sizes that suit it where
// none are asked for. Throws OptionError for what does not go together.
void settleSizing(const SizingUsage& usage, const DepthOptions& depths, bool may_choose, SizeOptions& sizes);

// A note for each size, or growth of sizes, that is asked for and that a bound on all sizes overrides.
std::vector<std::string> notesOnOverriddenSizes(const SizingUsage& usage, const SizeOptions& sizes);

}  // namespace coastmesh
