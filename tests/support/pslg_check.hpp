#pragma once

#include <string>

#include "core/pslg.hpp"

namespace coastmesh {

// The requirements of core/pslg.hpp and the agreement of labels around each vertex, tested naively and in rational
// arithmetic, with nothing in common with the code under test. Empty, or what is wrong.
std::string defectOfLabelled(const Pslg& pslg);

// Area of the places labelled `region`, by the labels of the segments alone.
double labelledArea(const Pslg& pslg, RegionId region);

}  // namespace coastmesh
