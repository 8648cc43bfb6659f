#include "gis/weirs/beds_at_weirs.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "gis/for_count.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/places.hpp"
#include "gis/rounded_depth.hpp"

namespace coastmesh {
namespace {

// Heights of the crests at the nodes of weirs, the lowest if there are several.
std::map<std::uint32_t, double> crestsAtNodes(const Grid& grid) {
  std::map<std::uint32_t, double> crests;
  for (const Boundary& boundary : grid.boundaries) {
    if (boundary.weir.empty()) continue;
    const std::size_t values = boundary.weir.size() / boundary.nodes.size();
    const auto add = [&](const std::vector<std::uint32_t>& nodes) {
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const double height = boundary.weir[i * values];
        double& crest = crests.try_emplace(nodes[i], height).first->second;
        crest = std::min(crest, height);
      }
    };
    add(boundary.nodes);
    add(boundary.back_nodes);
  }
  return crests;
}

}  // namespace

std::vector<std::string> WeirBeds::notes() const {
  if (lowered == 0) return {};
  return {std::to_string(lowered) +
          forCount(lowered, " node of a weir is not below its crest, and gets",
                   " nodes of weirs are not below their crests, and get") +
          " the depth beside it, the first at " + pointText(first)};
}

WeirBeds lowerBedsAtWeirs(Grid& grid) {
  constexpr double kBelowCrest = 0.1;  // metres
  WeirBeds beds;
  if (grid.z.empty()) return beds;
  const std::map<std::uint32_t, double> crests = crestsAtNodes(grid);
  const auto isTooHigh = [&](std::uint32_t node) {
    const auto crest = crests.find(node);
    return crest != crests.end() && grid.z[node] >= crest->second;
  };
  std::map<std::uint32_t, std::set<std::uint32_t>> beside;
  for (const auto& [node, crest] : crests)
    if (isTooHigh(node)) beside[node];
  if (beside.empty()) return beds;
  for (const GridCorners& corners : grid.triangles)
    for (const std::uint32_t node : corners)
      if (const auto found = beside.find(node); found != beside.end())
        for (const std::uint32_t other : corners)
          if (!crests.contains(other) && !std::isnan(grid.z[other])) found->second.insert(other);
  for (const auto& [node, others] : beside) {
    double sum = 0.0;
    for (const std::uint32_t other : others) sum += grid.z[other];
    const double most = crests.at(node) - kBelowCrest;
    const double mean = others.empty() ? most : sum / static_cast<double>(others.size());
    grid.z[node] = roundedDepth(std::min(mean, most));
    if (beds.lowered++ == 0) beds.first = grid.nodes[node];
  }
  return beds;
}

}  // namespace coastmesh
