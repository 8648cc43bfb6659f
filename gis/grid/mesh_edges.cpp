#include "gis/grid/mesh_edges.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace coastmesh {

std::vector<std::array<std::uint32_t, 2>> uniqueEdges(std::size_t nodes,
                                                      std::span<const std::array<std::uint32_t, 3>> triangles,
                                                      const ItemLoop& loop) {
  // In buckets by the lesser node, which hold a few edges each.
  std::vector<std::uint32_t> bucket(nodes + 1, 0);  // its end at first, then its beginning
  const auto forEachEdge = [&](auto&& use) {
    for (const auto& [a, b, c] : triangles) {
      use(std::min(a, b), std::max(a, b));
      use(std::min(b, c), std::max(b, c));
      use(std::min(c, a), std::max(c, a));
    }
  };
  forEachEdge([&](std::uint32_t low, std::uint32_t) { ++bucket[low]; });
  std::inclusive_scan(bucket.begin(), bucket.end(), bucket.begin());
  std::vector<std::uint32_t> ends;
  reserveOn(loop, ends, 3 * triangles.size());
  ends.resize(3 * triangles.size());
  forEachEdge([&](std::uint32_t low, std::uint32_t high) { ends[--bucket[low]] = high; });

  // Of the edges in a sorted bucket those that differ from the one before.
  const auto forEachOnce = [&](std::size_t low, auto&& use) {
    for (std::uint32_t i = bucket[low]; i < bucket[low + 1]; ++i)
      if (i == bucket[low] || ends[i] != ends[i - 1]) use(ends[i]);
  };
  struct Stretch {
    std::size_t first = 0, last = 0, edges = 0;  // nodes from first to last
  };
  std::vector<Stretch> stretches = overStretches(loop, nodes, [&](std::size_t first, std::size_t last) {
    Stretch stretch{first, last, 0};
    for (std::size_t low = first; low < last; ++low) {
      std::sort(ends.begin() + bucket[low], ends.begin() + bucket[low + 1]);
      forEachOnce(low, [&](std::uint32_t) { ++stretch.edges; });
    }
    return stretch;
  });
  std::size_t count = 0;
  for (Stretch& stretch : stretches) stretch.edges = std::exchange(count, count + stretch.edges);  // before it, now
  std::vector<std::array<std::uint32_t, 2>> edges;
  reserveOn(loop, edges, count);
  edges.resize(count);
  loop(stretches.size(), [&](std::size_t s) {
    std::size_t next = stretches[s].edges;
    for (std::size_t low = stretches[s].first; low < stretches[s].last; ++low)
      forEachOnce(low, [&](std::uint32_t high) { edges[next++] = {static_cast<std::uint32_t>(low), high}; });
  });
  return edges;
}

}  // namespace coastmesh
