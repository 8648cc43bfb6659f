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

// Joins edges end to end into lines of `kind` and `name`, each starting at its lesser end, a loop at its least node.
// Lines end where more than two edges meet. `edges` may repeat, in either direction.
std::vector<GridLine> chainLines(std::vector<NodePair> edges, LineKind kind, const std::string& name);

// One line if the edges follow one another and do not turn back, otherwise the result of `chainLines`.
std::vector<GridLine> linesAlong(const std::vector<NodePair>& edges, LineKind kind, const std::string& name);

// A line of nodes along edges; closed if its last node is its first and it has at least three edges.
GridLine lineOfNodes(LineKind kind, std::string name, std::vector<std::uint32_t> nodes);

}  // namespace coastmesh
