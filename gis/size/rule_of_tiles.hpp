#pragma once

#include "gis/size/size_rule.hpp"

namespace coastmesh {

// A size rule as a function on tiles.
TileRule tileRuleOf(const SizeRule& rule);

}  // namespace coastmesh
