#pragma once

#include <string>

#include "core/pslg.hpp"

namespace coastmesh {

// Reads Triangle's .poly (with its .node beside it if the vertex count is 0), numbered from 0 or 1, with comments,
// markers and hole points; attributes and regions are ignored. Segments are unlabelled; cleaning is left to the caller.
// Throws InputError with file and line.
Pslg readPoly(const std::string& path);

// Coordinates are read back bit for bit. The format has no labels: a face inside that they exclude from the domain gets
// a hole point. Throws OutputError.
void writePoly(const Pslg& pslg, const std::string& path);

}  // namespace coastmesh
