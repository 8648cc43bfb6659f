#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace coastmesh {

// True iff no list or value in the header of a classic NetCDF file (CDF-1, 2 or 5) claims more bytes than the file has,
// and all variables and attributes are of types that such files have; also for every other file. The NetCDF library
// allocates and reads whatever a damaged header claims.
bool headerFitsFile(const std::string& path);

// Where the values of each variable of a classic NetCDF file begin, in bytes, in the order of their numbers; of none
// where the file cannot be read. REQUIRES: what can be read of the header is sound.
std::vector<std::uint64_t> beginningsOfVariables(const std::string& path);

}  // namespace coastmesh
