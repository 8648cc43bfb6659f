#pragma once

#include <string>

namespace coastmesh {

// All bytes of a file or of a pipe. Memory: little more than those. Throws InputError with the path and the system's
// reason.
std::string wholeFile(const std::string& path);

}  // namespace coastmesh
