#pragma once

#include "tests/fuzz/choices.hpp"
#include "tests/fuzz/refine_case.hpp"

namespace coastmesh {

// A random input of some dozen points, of a shape that is easy to get wrong, with random options. Most are valid PSLGs;
// rounding makes constrainedDelaunay refuse a few.
RefineCase randomCase(Choices& choices);

}  // namespace coastmesh
