#pragma once

#include <string>
#include <vector>

#include "apps/command_line.hpp"
#include "gis/size_source.hpp"

namespace coastmesh {

// What a command is told about sizes.
struct SizingUsage {
  std::vector<std::string> bands;
  std::string depth_positive = "up";
  bool filter_given = false;
};

// Declares the options that say how large elements should be; `sizes` and `usage` must outlive the parsing.
void declareSizing(CommandLine& line, SizeOptions& sizes, SizingUsage& usage);

// Once parsed. Throws UsageError for what does not go together.
void settleSizing(const SizingUsage& usage, SizeOptions& sizes);

}  // namespace coastmesh
