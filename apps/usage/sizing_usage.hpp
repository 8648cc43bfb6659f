#pragma once

#include <string>
#include <vector>

#include "apps/usage/command_line.hpp"
#include "gis/model/depth.hpp"
#include "gis/size/size_source.hpp"

namespace coastmesh {

// What a command is given about sizes.
struct SizingUsage {
  std::vector<std::string> bands;
  bool filter_given = false;
  bool coast_given = false;
  bool grade_given = false;
};

// Declares the options that say how large elements should be; `sizes` and `usage` must outlive the parsing.
void declareSizing(CommandLine& line, SizeOptions& sizes, SizingUsage& usage);

// Once parsed: `depths` are where sizes find theirs. A sea for a model, `may_choose`, gets sizes that suit it where
// none are asked for. Throws OptionError for what does not go together.
void settleSizing(const SizingUsage& usage, const DepthOptions& depths, bool may_choose, SizeOptions& sizes);

}  // namespace coastmesh
