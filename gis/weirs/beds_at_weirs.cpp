#include "gis/weirs/beds_at_weirs.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "gis/for_count.hpp"
#include "gis/grid/grid_edit.hpp"
#include "gis/places.hpp"
#include "gis/rounded_depth.hpp"

namespace coastmesh {
namespace {

constexpr double kAboveBed = 0.1;  // metres, of a crest

std::size_t valuesAt(const Boundary& weir) { return weir.weir.size() / weir.nodes.size(); }

// The bed beside nodes: the mean of their neighbours that are no weir's. NaN if there are none.
class BedsBeside {
 public:
  // Of the nodes in `wanted`; `of_weirs`: all nodes of weirs.
  BedsBeside(const Grid& grid, const std::set<std::uint32_t>& wanted, const std::set<std::uint32_t>& of_weirs) {
    std::map<std::uint32_t, std::set<std::uint32_t>> beside;
    for (const GridCorners& corners : grid.triangles)
      for (const std::uint32_t node : corners)
        if (wanted.contains(node))
          for (const std::uint32_t other : corners)
            if (!of_weirs.contains(other) && !std::isnan(grid.z[other])) beside[node].insert(other);
    for (const auto& [node, others] : beside) {
      double sum = 0.0;
      for (const std::uint32_t other : others) sum += grid.z[other];
      if (!others.empty()) mean_[node] = sum / static_cast<double>(others.size());
    }
  }

  double at(std::uint32_t node) const {
    const auto found = mean_.find(node);
    return found == mean_.end() ? NAN : found->second;
  }

 private:
  std::map<std::uint32_t, double> mean_;
};

}  // namespace

std::vector<std::string> WeirBeds::notes() const {
  std::vector<std::string> all;
  if (lowered > 0)
    all.push_back(std::to_string(lowered) +
                  forCount(lowered, " node of a weir was as high as its crest, and has",
                           " nodes of weirs were as high as their crests, and have") +
                  " the depth beside it now, the first at " + pointText(first_lowered));
  if (raised > 0)
    all.push_back("the ground is as high as the crest at " + std::to_string(raised) +
                  forCount(raised, " pair of nodes of a weir, whose crest is raised",
                           " pairs of nodes of weirs, whose crests are raised") +
                  amount(" to %g m above it", kAboveBed) + ", the first at " + pointText(first_raised));
  return all;
}

WeirBeds fitWeirsToBeds(Grid& grid) {
  WeirBeds beds;
  if (grid.z.empty()) return beds;
  std::set<std::uint32_t> of_weirs, high;
  const auto forEachPair = [&grid](const auto& act) {
    for (Boundary& boundary : grid.boundaries) {
      for (std::size_t i = 0; !boundary.weir.empty() && i < boundary.nodes.size(); ++i) {
        std::vector<std::uint32_t> nodes{boundary.nodes[i]};
        if (!boundary.back_nodes.empty()) nodes.push_back(boundary.back_nodes[i]);
        act(nodes, boundary.weir[i * valuesAt(boundary)]);
      }
    }
  };
  forEachPair([&](const std::vector<std::uint32_t>& nodes, double height) {
    of_weirs.insert(nodes.begin(), nodes.end());
    for (const std::uint32_t node : nodes)
      if (grid.z[node] >= height) high.insert(node);
  });
  if (high.empty()) return beds;
  const BedsBeside beside(grid, high, of_weirs);
  forEachPair([&](const std::vector<std::uint32_t>& nodes, double& height) {
    double highest = -std::numeric_limits<double>::infinity();
    for (const std::uint32_t node : nodes) {
      if (grid.z[node] >= height && beside.at(node) <= height - kAboveBed) {
        grid.z[node] = roundedDepth(beside.at(node));
        if (beds.lowered++ == 0) beds.first_lowered = grid.nodes[node];
      }
      highest = std::max(highest, grid.z[node]);
    }
    if (highest < height) return;
    height = roundedDepth(highest + kAboveBed);
    if (beds.raised++ == 0) beds.first_raised = grid.nodes[nodes.front()];
  });
  return beds;
}

}  // namespace coastmesh
