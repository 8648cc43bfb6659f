#pragma once

#include <string>

#include "tests/fuzz/refine_case.hpp"

namespace coastmesh {

// The corpus format: Triangle's .poly, the options in comment lines before it ("# min_angle 33"), the labels of
// segments in comments behind them ("1 1 2 7 # 0 -1": left and right). Coordinates come back bit for bit.
// Throws InputError with file and line.
RefineCase readCase(const std::string& path);

// Throws std::runtime_error where the file cannot be written.
void writeCase(const RefineCase& refine_case, const std::string& note, const std::string& path);

}  // namespace coastmesh
