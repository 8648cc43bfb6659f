#pragma once

#include <optional>
#include <string_view>

namespace coastmesh {

// Metres in a unit of length as files name it: "km", "US survey foot", "metres above mean sea level". 1 if the name
// is empty or a placeholder ("1", "unknown"); nullopt if it is not a length: "m/s", "degrees".
std::optional<double> metresInUnit(std::string_view name);

}  // namespace coastmesh
