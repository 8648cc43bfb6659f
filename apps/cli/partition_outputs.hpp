#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/usage/option_table.hpp"
#include "gis/solver/partition_grid.hpp"

namespace coastmesh {

inline constexpr std::uint64_t kMostParts = 1'000'000;

// Declares --partition. It counts only with an output that holds parts.
void declareParts(OptionTable& table, std::uint64_t& parts, const std::vector<std::string>& outputs,
                  const std::string& format);

// What of the mesh is to be partitioned for these outputs. Throws OptionError where one of them holds parts and nothing
// else, and none are asked for.
PartitionOptions partitionFor(std::uint64_t parts, const std::vector<std::string>& outputs, const std::string& format);

}  // namespace coastmesh
