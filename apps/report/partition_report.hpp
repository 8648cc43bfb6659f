#pragma once

#include <string>

#include "apps/report/report_sections.hpp"
#include "gis/solver/partition_grid.hpp"

namespace coastmesh {

// null if the grid was not partitioned.
Json partitionSection(const PartitionReport& report);

// For users: a line each for elements and nodes; empty if the grid was not partitioned.
std::string partitionText(const PartitionReport& report);

}  // namespace coastmesh
