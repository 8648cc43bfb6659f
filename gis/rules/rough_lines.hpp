#pragma once

#include <vector>

#include "core/item_loop.hpp"
#include "gis/rules/edge_search.hpp"
#include "gis/rules/rule_shapes.hpp"

namespace coastmesh {

// A part of the boundary that a rule asks for and does not get.
struct MissedPart {
  std::size_t rule = 0;
  bool whole = false;     // it defines no edge
  Point place;            // the middle of the part, in the layer's CRS
  std::size_t parts = 1;  // such parts of a line, of which this is the longest
};

// Gives edges to lines that follow the boundary only roughly. Lines of one type that continue each other are one.
// - An edge is along a line that passes most of it within half an element, no other edge being closer.
// - Where a line leaves the boundary and comes back, edges between are along it if they stay within 1.5 elements of it,
//   and are not much longer.
// - A line or polygon that is shorter than two elements and has no edge gets the one closest to its middle, if that is
//   within an element.
// Returns where lines and polygons that open something get no edge: all of one; or parts of a line between others that
// have some, or along two elements and more, that are near the boundary. `used` are the rules with areas that contain
// an edge.
std::vector<MissedPart> takeRoughly(const RuleShapes& shapes, const std::vector<BoundaryRule>& rules,
                                    const RulePlane& plane, const std::vector<bool>& used, std::vector<NearEdge>& edges,
                                    const ItemLoop& loop = inOrder);

}  // namespace coastmesh
