#pragma once

#include <string>
#include <vector>

#include "apps/command_line.hpp"
#include "gis/depth.hpp"
#include "gis/size_source.hpp"

namespace coastmesh {

// What a command is told about sizes.
struct SizingUsage {
  std::vector<std::string> bands;
  bool filter_given = false;
};

// Declares the options that say how large elements should be; `sizes` and `usage` must outlive the parsing.
void declareSizing(CommandLine& line, SizeOptions& sizes, SizingUsage& usage);

// Once parsed: `depths` are where sizes find theirs. Throws UsageError for what does not go together.
void settleSizing(const SizingUsage& usage, const DepthOptions& depths, SizeOptions& sizes);

}  // namespace coastmesh
