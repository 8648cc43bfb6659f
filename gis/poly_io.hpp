#pragma once

#include <string>

#include "core/pslg.hpp"

namespace coastmesh {

// Triangle's .poly (with its .node beside it where the vertex count is 0), numbered from 0 or 1, with comments,
// attributes, markers and hole points. Cleaning is the caller's. Throws InputError with file and line.
Pslg readPoly(const std::string& path);
void writePoly(const Pslg& pslg, const std::string& path);  // 17 digits: coordinates come back bit for bit

}  // namespace coastmesh
