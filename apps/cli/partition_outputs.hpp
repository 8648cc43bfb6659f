#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/usage/option_table.hpp"
#include "gis/solver/partition_grid.hpp"

namespace coastmesh {

inline constexpr std::uint64_t kMostParts = 1'000'000;

// Declares --partition. It has an effect only with an output that holds parts.
void declareParts(OptionTable& table, std::uint64_t& parts, const std::vector<std::string>& outputs,
                  const std::string& format);

// What to partition for these outputs. Throws OptionError if an output that holds only parts is given without a number
// of parts, or is a folder for another number of them.
PartitionOptions partitionFor(std::uint64_t parts, const std::vector<std::string>& outputs, const std::string& format);

}  // namespace coastmesh
