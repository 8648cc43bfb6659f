#pragma once

#include <string>

namespace coastmesh {

// All bytes of a file or a pipe. Takes little more memory than these. Throws InputError with the path and the system's
// reason.
std::string wholeFile(const std::string& path);

}  // namespace coastmesh
