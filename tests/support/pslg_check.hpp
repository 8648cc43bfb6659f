#pragma once

#include <string>

#include "core/pslg.hpp"

namespace coastmesh {

// Checks the requirements of core/pslg.hpp and the agreement of labels around each vertex, naively and in rational
// arithmetic, independently of the code under test. Returns the first defect; empty if there is none.
std::string defectOfLabelled(const Pslg& pslg);

// The area labelled `region`, from the labels of the segments alone.
double labelledArea(const Pslg& pslg, RegionId region);

}  // namespace coastmesh
