#pragma once

#include <optional>
#include <string_view>

namespace coastmesh {

// Metres in a unit of length as rasters name it: "km", "US survey foot", "metres above mean sea level". 1 where the
// name is empty or a placeholder ("1", "unknown"); nothing where it is no length: "m/s", "degrees".
std::optional<double> metresInUnit(std::string_view name);

}  // namespace coastmesh
