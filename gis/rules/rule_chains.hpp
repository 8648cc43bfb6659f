#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "gis/rules/rule_shapes.hpp"

namespace coastmesh {

// A part of a rule's line, or all of it.
struct RuleLine {
  std::size_t rule = 0;
  std::vector<Point> points;
};

// Lines of one type, each beginning where the one before ends.
using RuleChain = std::vector<RuleLine>;

// Joins lines of one type whose ends are within `reach(end)` of each other, in any turn and either direction. Shores of
// polygons stay alone.
std::vector<RuleChain> chainsOf(const RuleShapes& shapes, const std::vector<BoundaryRule>& rules,
                                const RulePlane& plane, const std::function<double(const Point&)>& reach);

}  // namespace coastmesh
