#pragma once

#include <string>

namespace coastmesh {

// True if PROJ can look up the code of a CRS, such as "EPSG:4326".
bool isKnownCode(const std::string& code);

}  // namespace coastmesh
