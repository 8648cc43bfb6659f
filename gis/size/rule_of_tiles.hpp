#pragma once

#include "gis/size/size_rule.hpp"

namespace coastmesh {

// What a rule says, for tiles.
TileRule tileRuleOf(const SizeRule& rule);

}  // namespace coastmesh
