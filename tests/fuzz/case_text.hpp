#pragma once

#include <string>

#include "tests/fuzz/refine_case.hpp"

namespace coastmesh {

// A case in the corpus format, see case_file.hpp. `note` is written as comment lines.
std::string caseText(const RefineCase& refine_case, const std::string& note);

}  // namespace coastmesh
