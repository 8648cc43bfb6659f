#include "gis/merge/same_nodes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/metric.hpp"
#include "gis/geometry/box_tree.hpp"

namespace coastmesh {

namespace {

constexpr double kSame = 0.01;

}  // namespace

std::vector<std::uint32_t> sameNodes(const Grid& grid, const Outline& outline, const ItemLoop& loop) {
  std::vector<std::pair<std::uint32_t, double>> nodes;  // of the outline, with the square of the distance allowed
  for (const Outline::Edge& edge : outline.edges()) {
    const double squared = kSame * kSame * squaredDistance(outline.place(edge.a), outline.place(edge.b));
    nodes.emplace_back(edge.a, squared);
    nodes.emplace_back(edge.b, squared);
  }
  std::ranges::sort(nodes);  // the shortest edge of each node first
  const auto [repeated, end] = std::ranges::unique(nodes, {}, [](const auto& node) { return node.first; });
  nodes.erase(repeated, end);
  std::vector<Box> boxes;
  for (const auto& [node, squared] : nodes)
    boxes.push_back(Box::of(outline.place(node), outline.place(node)).grownBy(std::sqrt(squared)));
  const BoxTree tree(boxes, BoxTree::Order::Hilbert, loop);
  std::vector<std::uint32_t> same(grid.nodes.size(), kNone);
  forEachByStretches(loop, grid.nodes.size(), [&](std::size_t v) {
    double least = std::numeric_limits<double>::infinity();
    tree.visit(Box::of(grid.nodes[v], grid.nodes[v]), [&](std::uint32_t i) {
      const auto [node, squared] = nodes[i];
      const double between = squaredDistance(grid.nodes[v], outline.place(node));
      if (between <= squared && between < least) {
        least = between;
        same[v] = node;
      }
    });
  });
  // Of several nodes at one place, the nearest is the same.
  std::vector<std::array<std::uint32_t, 2>> pairs;
  for (std::uint32_t v = 0; v < same.size(); ++v)
    if (same[v] != kNone) pairs.push_back({same[v], v});
  std::ranges::sort(pairs, [&](const auto& a, const auto& b) {
    const auto between = [&](const auto& pair) { return squaredDistance(grid.nodes[pair[1]], outline.place(pair[0])); };
    return a[0] != b[0] ? a[0] < b[0] : std::pair(between(a), a[1]) < std::pair(between(b), b[1]);
  });
  for (std::size_t i = 1; i < pairs.size(); ++i)
    if (pairs[i][0] == pairs[i - 1][0]) same[pairs[i][1]] = kNone;
  return same;
}

}  // namespace coastmesh
