#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/usage/option_table.hpp"
#include "gis/solver/partition_grid.hpp"

namespace coastmesh {

inline constexpr std::uint64_t kMostParts = 1'000'000;

struct PartsUsage {
  std::uint64_t parts = 0;
  std::string weight;  // "even" or a nodal attribute; empty: what suits the outputs
  std::string levels;  // a file with a model's vertical grid
};

// Declares --partition, which has an effect only with an output that holds parts, and what `declarePartWeights` does.
void declareParts(OptionTable& table, PartsUsage& usage, const std::vector<std::string>& outputs,
                  const std::string& format);

// Declares --partition-weight and --partition-levels.
void declarePartWeights(OptionTable& table, PartsUsage& usage);

// What to partition for these outputs, and by which work. Throws OptionError if an output that holds only parts is
// given without a number of parts, or is a folder for another number of them, and for a file that is no vertical grid;
// InputError if that file is unreadable.
PartitionOptions partitionFor(const PartsUsage& usage, const std::vector<std::string>& outputs,
                              const std::string& format);

}  // namespace coastmesh
