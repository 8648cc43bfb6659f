#include "gis/grid/mesh_edges.hpp"

#include <algorithm>

namespace coastmesh {

std::vector<std::array<std::uint32_t, 2>> uniqueEdges(std::size_t nodes,
                                                      std::span<const std::array<std::uint32_t, 3>> triangles) {
  // In buckets by the lesser node, which hold a few edges each.
  std::vector<std::uint32_t> first(nodes + 1, 0);
  const auto forEachEdge = [&](auto&& use) {
    for (const auto& [a, b, c] : triangles) {
      use(std::min(a, b), std::max(a, b));
      use(std::min(b, c), std::max(b, c));
      use(std::min(c, a), std::max(c, a));
    }
  };
  forEachEdge([&](std::uint32_t low, std::uint32_t) { ++first[low + 1]; });
  for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
  std::vector<std::uint32_t> ends(3 * triangles.size());
  std::vector<std::uint32_t> fill(first.begin(), first.end() - 1);
  forEachEdge([&](std::uint32_t low, std::uint32_t high) { ends[fill[low]++] = high; });

  std::vector<std::array<std::uint32_t, 2>> edges;
  edges.reserve(ends.size() / 2 + nodes);
  for (std::uint32_t low = 0; low < nodes; ++low) {
    const auto begin = ends.begin() + first[low], end = ends.begin() + first[low + 1];
    std::sort(begin, end);
    for (auto high = begin, last = std::unique(begin, end); high != last; ++high) edges.push_back({low, *high});
  }
  return edges;
}

}  // namespace coastmesh
