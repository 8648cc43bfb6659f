#include "gis/format/edited_layers.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

#include "gis/elements/measure_unknown.hpp"
#include "gis/for_count.hpp"
#include "gis/grid/boundary_chains.hpp"
#include "gis/places.hpp"

namespace coastmesh {

namespace {

// Metres, and a share of the depth: columns may be of single precision, and points have few decimals in some formats.
constexpr double kRounding = 1e-6;
// The columns of a .dbf have no room for more.
constexpr double kWidest = 1e7;

bool isKnown(double depth) { return !std::isnan(depth); }

bool areAlike(double column, double point) {
  return std::abs(point) > kWidest || std::abs(column - point) <= kRounding * std::max(1.0, std::abs(point));
}

std::string depthInWords(double depth) { return isKnown(depth) ? amount("%.10g", depth) : "none"; }

// Where the first edge of `boundary` begins that is not in `kept`.
Point firstOf(const std::vector<NodePair>& boundary, const std::vector<NodePair>& kept, const Grid& grid) {
  std::vector<NodePair> keys;
  for (const NodePair& edge : kept) keys.push_back(edgeKey(edge[0], edge[1]));
  std::ranges::sort(keys);
  const auto at = std::ranges::find_if(
      boundary, [&](const NodePair& edge) { return !std::ranges::binary_search(keys, edgeKey(edge[0], edge[1])); });
  assert(at != boundary.end());
  return grid.nodes[(*at)[0]];
}

}  // namespace

std::vector<double> depthsIn(const LayerDepths& layer, std::span<const std::int64_t> ids,
                             std::vector<std::string>& notes) {
  const auto& [column, points] = layer;
  assert(column.size() == ids.size() && points.size() == ids.size());
  if (std::ranges::none_of(column, isKnown)) return points;
  std::vector<double> depths(column);
  std::size_t differing = 0, first = 0;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (!isKnown(points[i])) continue;
    if (areAlike(column[i], points[i]))
      depths[i] = points[i];
    else if (differing++ == 0)
      first = i;
  }
  if (differing > 0)
    notes.push_back(std::to_string(differing) +
                    forCount(differing, " node has another depth in the column z than its point has",
                             " nodes have other depths in the column z than their points have") +
                    ", the first node " + std::to_string(ids[first]) + " (" + depthInWords(column[first]) +
                    ", its point " + depthInWords(points[first]) +
                    "): the column counts; delete it if the points are right");
  return depths;
}

void measureNewCorners(Grid& grid, std::span<const std::int64_t> ids) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  if (grid.nodes.size() == ids.size()) return;
  std::vector<bool> is_corner(grid.nodes.size(), false);
  for (std::size_t t = 0; t < grid.triangles.size(); ++t) {
    for (const std::uint32_t node : grid.triangles[t]) {
      is_corner[node] = true;
      if (node < ids.size()) continue;
      if (!grid.min_angle_deg.empty()) grid.min_angle_deg[t] = kUnknown;
      if (!grid.area_m2.empty()) grid.area_m2[t] = kUnknown;
    }
  }
  measureUnknown(grid, inOrder);
  const std::size_t corners = grid.nodes.size() - ids.size();
  std::string note = std::to_string(corners) +
                     forCount(corners, " corner of triangles is at no point of the layer of nodes, at ",
                              " corners of triangles are at no point of the layer of nodes, the first at ") +
                     placeInWords(grid.nodes[ids.size()]) +
                     forCount(corners, ": it becomes a node without a depth", ": they become nodes without depths");
  const auto unused = static_cast<std::size_t>(std::ranges::count(is_corner, false));
  if (unused > 0) {
    const auto first = static_cast<std::size_t>(std::ranges::find(is_corner, false) - is_corner.begin());
    note += "; " + std::to_string(unused) +
            forCount(unused, " node of that layer is no corner, node ",
                     " nodes of that layer are no corners, the first node ") +
            std::to_string(ids[first]) + ": corners have to be moved in both layers";
  }
  grid.notes.push_back(std::move(note));
}

void noteStrayBoundaries(Grid& grid) {
  std::vector<std::vector<NodePair>> given;
  for (const Boundary& boundary : grid.boundaries) given.push_back(edgesOf(boundary));
  std::vector<std::vector<NodePair>> on_outline = given;
  keepBoundaryEdges(grid.triangles, on_outline);
  std::size_t stray = 0;
  std::optional<Point> first;
  for (std::size_t b = 0; b < given.size(); ++b) {
    if (given[b].size() == on_outline[b].size()) continue;
    stray += given[b].size() - on_outline[b].size();
    if (!first) first = firstOf(given[b], on_outline[b], grid);
  }
  if (!first) return;
  grid.notes.push_back(std::to_string(stray) +
                       forCount(stray, " edge of boundaries is not on the outline of the triangles, at ",
                                " edges of boundaries are not on the outline of the triangles, the first at ") +
                       placeInWords(*first) +
                       ": convert --target makes boundaries that are; without the layer of boundaries all are made "
                       "anew, as land and islands");
}

}  // namespace coastmesh
