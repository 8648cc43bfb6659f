#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "gis/grid/boundary_chains.hpp"
#include "gis/grid/grid.hpp"

namespace coastmesh {

inline constexpr std::array kLineKinds{LineKind::Constraint, LineKind::Weir, LineKind::RegionBorder};
std::string_view toString(LineKind kind);  // "constraint", "weir", "region border"
std::optional<LineKind> lineKindNamed(std::string_view name);

// The edges of a line, in its direction.
std::vector<NodePair> edgesOf(const GridLine& line);

// Edges end to end as lines of `kind` and `name`, each from its lesser end on; a loop starts at its least node. Where
// more than two edges meet, lines end. `edges` may repeat and go either way.
std::vector<GridLine> chainLines(std::vector<NodePair> edges, LineKind kind, const std::string& name);

// Edges that follow one another as one line; others, and those that turn back, as `chainLines` has them.
std::vector<GridLine> linesAlong(const std::vector<NodePair>& edges, LineKind kind, const std::string& name);

// Nodes along edges as a line; one whose last node is its first is closed, if that makes three edges.
GridLine lineOfNodes(LineKind kind, std::string name, std::vector<std::uint32_t> nodes);

}  // namespace coastmesh
