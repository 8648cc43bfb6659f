#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace coastmesh {

// True if no list, value or variable in the header of a classic NetCDF file (CDF-1, 2 or 5) claims more bytes than the
// file has, and all variables and attributes have types of such files; true for every other file. The NetCDF library
// allocates and reads whatever a damaged header claims, and reads zeros where a file is cut off.
bool headerFitsFile(const std::string& path);

// The offset in bytes of the values of each variable of a classic NetCDF file, in the order of their numbers; empty if
// the file cannot be read. REQUIRES: the readable part of the header is valid.
std::vector<std::uint64_t> beginningsOfVariables(const std::string& path);

}  // namespace coastmesh
