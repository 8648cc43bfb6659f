#pragma once

#include <string>

#include "tests/fuzz/refine_case.hpp"

namespace coastmesh {

// The corpus format: Triangle's .poly, with options in comment lines before it ("# min_angle 33") and the labels of
// segments in trailing comments ("1 1 2 7 # 0 -1": left and right). Coordinates are preserved bit for bit. Throws
// InputError with file and line.
RefineCase readCase(const std::string& path);

// Throws std::runtime_error if the file cannot be written.
void writeCase(const RefineCase& refine_case, const std::string& note, const std::string& path);

}  // namespace coastmesh
