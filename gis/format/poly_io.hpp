#pragma once

#include <string>

#include "core/pslg.hpp"

namespace coastmesh {

// Triangle's .poly (with its .node beside it where the vertex count is 0), numbered from 0 or 1, with comments,
// attributes (passed over), markers, hole points and regions (passed over). Segments come unlabelled. Cleaning is the
// caller's. Throws InputError with file and line.
Pslg readPoly(const std::string& path);

// Coordinates come back bit for bit. Labels have no place in the format: a face inside that they leave out of the
// domain gets a hole point. Throws OutputError.
void writePoly(const Pslg& pslg, const std::string& path);

}  // namespace coastmesh
