#include "gis/grid/marked_edges.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

#include "gis/grid/grid_lines.hpp"

namespace coastmesh {
namespace {

constexpr std::int64_t kMarkerStep = 10, kFirstLineMarker = 5;

MarkerKind kindOf(std::int64_t marker) {
  const std::int64_t digit = marker % kMarkerStep;
  if (marker < kMarkerStep) return {};
  for (const BoundaryRole role : kBoundaryRoles)
    if (digit == boundaryMarker(0, role) % kMarkerStep) return role;
  for (const LineKind kind : kLineKinds)
    if (digit == lineMarker(0, kind) % kMarkerStep) return kind;
  return {};
}

}  // namespace

std::int64_t boundaryMarker(std::size_t index, BoundaryRole role) {
  return kMarkerStep * static_cast<std::int64_t>(index + 1) + 1 + static_cast<std::int64_t>(role);
}

std::int64_t lineMarker(std::size_t index, LineKind kind) {
  return kMarkerStep * static_cast<std::int64_t>(index + 1) + kFirstLineMarker + static_cast<std::int64_t>(kind);
}

std::vector<MarkerKind> kindsOfMarkers(std::span<const std::int64_t> markers) {
  const std::set<std::int64_t> all(markers.begin(), markers.end());
  std::set<std::int64_t> numbers;  // indices, counted from 1
  for (const std::int64_t marker : all) {
    if (std::holds_alternative<std::monostate>(kindOf(marker))) continue;
    const std::int64_t number = marker / kMarkerStep;
    if (number > 2 * std::ssize(all) || !numbers.insert(number).second) return std::vector<MarkerKind>(markers.size());
  }
  std::vector<MarkerKind> kinds(markers.size());
  if (2 * numbers.size() >= all.size()) std::ranges::transform(markers, kinds.begin(), kindOf);
  return kinds;
}

std::vector<MarkedEdge> markedEdges(const Grid& grid) {
  std::vector<MarkedEdge> all;
  const auto add = [&](const std::vector<NodePair>& edges, std::int64_t marker) {
    for (const NodePair& edge : edges) all.push_back({edge, marker});
  };
  for (std::size_t b = 0; b < grid.boundaries.size(); ++b)
    add(edgesOf(grid.boundaries[b]), boundaryMarker(b, grid.boundaries[b].role));
  for (std::size_t i = 0; i < grid.lines.size(); ++i)
    add(edgesOf(grid.lines[i]), lineMarker(grid.boundaries.size() + i, grid.lines[i].kind));
  return all;
}

void takeMarkedEdges(std::span<const MarkedEdge> edges, Grid& grid) {
  std::map<std::int64_t, std::vector<NodePair>> edges_of;
  for (const auto& [nodes, marker] : edges) edges_of[marker].push_back(nodes);
  std::vector<std::int64_t> markers;
  std::vector<std::vector<NodePair>> groups;
  for (auto& [marker, group] : edges_of) {
    markers.push_back(marker);
    groups.push_back(std::move(group));
  }
  const std::vector<MarkerKind> kinds = kindsOfMarkers(markers);
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    if (std::holds_alternative<BoundaryRole>(kinds[k])) continue;
    if (const LineKind* const kind = std::get_if<LineKind>(&kinds[k]))
      std::ranges::move(linesAlong(groups[k], *kind, {}), std::back_inserter(grid.lines));
    groups[k].clear();
  }
  keepBoundaryEdges(grid.triangles, groups);
  for (std::size_t k = 0; k < groups.size(); ++k) {
    for (Boundary& chain : chainEdges(groups[k])) {
      chain.role = std::get<BoundaryRole>(kinds[k]);
      grid.boundaries.push_back(std::move(chain));
    }
  }
}

}  // namespace coastmesh
