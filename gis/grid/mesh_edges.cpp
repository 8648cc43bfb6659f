#include "gis/grid/mesh_edges.hpp"

#include <algorithm>
#include <bit>
#include <functional>
#include <numeric>
#include <utility>

#include "core/bulk_list.hpp"

namespace coastmesh {

namespace {

using Triangles = std::span<const std::array<std::uint32_t, 3>>;
using Edge = std::array<std::uint32_t, 2>;

template <typename Use>
void forEachEdge(Triangles triangles, const Use& use) {
  for (const auto& [a, b, c] : triangles) {
    use(std::min(a, b), std::max(a, b));
    use(std::min(b, c), std::max(b, c));
    use(std::min(c, a), std::max(c, a));
  }
}

// Nodes are divided into stretches of consecutive numbers, of equal length. An edge belongs to the stretch of its
// lesser node.
struct Stretches {
  std::size_t nodes = 0, count = 0;

  std::size_t begin(std::size_t stretch) const { return (nodes * stretch + count - 1) / count; }
  std::size_t of(std::uint32_t node) const { return node * count / nodes; }
};

// Consecutive triangles, and a bit for each stretch that one of their edges belongs to.
struct Block {
  Triangles triangles;
  std::uint64_t stretches = 0;

  template <typename Use>
  void forEachStretch(const Use& use) const {
    for (std::uint64_t rest = stretches; rest != 0; rest &= rest - 1)
      use(static_cast<std::size_t>(std::countr_zero(rest)));
  }
};

std::vector<Block> blocksOf(Triangles triangles, const Stretches& stretches, const ItemLoop& loop) {
  constexpr std::size_t kBlock = 1024;
  std::vector<Block> blocks((triangles.size() + kBlock - 1) / kBlock);
  const auto make = [&](std::size_t b) {
    blocks[b].triangles = triangles.subspan(b * kBlock, std::min(kBlock, triangles.size() - b * kBlock));
    forEachEdge(blocks[b].triangles, [&](std::uint32_t low, std::uint32_t) {
      blocks[b].stretches |= std::uint64_t{1} << stretches.of(low);
    });
  };
  forStretches(
      loop, blocks.size(),
      [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) make(b);
      },
      8);
  return blocks;
}

// For each stretch the number of blocks with an edge of it.
std::vector<std::uint64_t> visitsOf(const std::vector<Block>& blocks, const Stretches& stretches,
                                    const ItemLoop& loop) {
  std::vector<std::uint64_t> visits(stretches.count, 0);
  for (const auto& some : overStretches(loop, blocks.size(), [&](std::size_t first, std::size_t last) {
         std::vector<std::uint64_t> here(stretches.count, 0);
         for (std::size_t b = first; b < last; ++b) blocks[b].forEachStretch([&](std::size_t s) { ++here[s]; });
         return here;
       }))
    std::ranges::transform(visits, some, visits.begin(), std::plus<>());
  return visits;
}

std::uint64_t sumOf(const std::vector<std::uint64_t>& visits) {
  return std::accumulate(visits.begin(), visits.end(), std::uint64_t{0});
}

// The blocks with an edge of each stretch, ascending.
struct OwnBlocks {
  std::vector<std::uint64_t> first;  // of each stretch in `blocks`, then the end
  std::vector<std::uint32_t> blocks;

  std::span<const std::uint32_t> of(std::size_t stretch) const {
    return std::span(blocks).subspan(first[stretch], first[stretch + 1] - first[stretch]);
  }
};

OwnBlocks ownBlocks(const std::vector<Block>& blocks, const std::vector<std::uint64_t>& visits) {
  OwnBlocks own;
  own.first.assign(visits.size() + 1, 0);
  std::inclusive_scan(visits.begin(), visits.end(), own.first.begin() + 1);
  own.blocks.resize(own.first.back());
  std::vector<std::uint64_t> next(own.first.begin(), own.first.end() - 1);
  for (std::size_t b = 0; b < blocks.size(); ++b)
    blocks[b].forEachStretch([&](std::size_t s) { own.blocks[next[s]++] = static_cast<std::uint32_t>(b); });
  return own;
}

// Merges stretches in pairs.
void halve(std::vector<Block>& blocks, Stretches& stretches) {
  for (Block& block : blocks) {
    std::uint64_t halved = 0;
    block.forEachStretch([&](std::size_t s) { halved |= std::uint64_t{1} << s / 2; });
    block.stretches = halved;
  }
  stretches.count /= 2;
}

// The edges of each stretch that far more blocks have an edge in than in others, as in that of the shore's nodes if
// rows of triangles end there; none for other stretches. One thread would go through nearly all triangles for them.
// Some are there twice. Counted first: one list for each range of blocks would keep more memory.
std::vector<BulkList<Edge>> widespreadEdges(const std::vector<Block>& blocks, const Stretches& stretches,
                                            const OwnBlocks& own, const ItemLoop& loop) {
  constexpr std::size_t kFarMore = 4, kRanges = 256;
  std::vector<BulkList<Edge>> edges(stretches.count);
  for (std::size_t s = 0; s < stretches.count; ++s) {
    const std::span<const std::uint32_t> here = own.of(s);
    if (here.size() * stretches.count <= kFarMore * own.blocks.size()) continue;
    const auto forEachOwn = [&](std::size_t range, const auto& use) {
      for (std::size_t i = here.size() * range / kRanges; i < here.size() * (range + 1) / kRanges; ++i)
        forEachEdge(blocks[here[i]].triangles, [&](std::uint32_t low, std::uint32_t high) {
          if (low >= stretches.begin(s) && low < stretches.begin(s + 1)) use(Edge{low, high});
        });
    };
    std::vector<std::size_t> next(kRanges + 1, 0);
    loop(kRanges, [&](std::size_t r) { forEachOwn(r, [&](const Edge&) { ++next[r + 1]; }); });
    std::inclusive_scan(next.begin(), next.end(), next.begin());
    resizeUnset(edges[s], next.back());
    loop(kRanges, [&](std::size_t r) {
      std::size_t at = next[r];
      forEachOwn(r, [&](const Edge& edge) { edges[s][at++] = edge; });
    });
  }
  return edges;
}

// The edges of a stretch: for each of its nodes the greater neighbours, each once, ascending.
struct NodeEdges {
  std::vector<std::uint32_t> begin;  // the start for each node, then the end
  std::vector<std::uint32_t> greater;
};

// `known`: its edges, if they have been listed.
NodeEdges edgesOfStretch(const std::vector<Block>& blocks, const Stretches& stretches, std::size_t stretch,
                         std::span<const std::uint32_t> own, std::span<const Edge> known) {
  const std::size_t first = stretches.begin(stretch), nodes = stretches.begin(stretch + 1) - first;
  const auto forEachOwn = [&](const auto& use) {
    for (const auto& [low, high] : known) use(low - first, high);
    if (!known.empty()) return;
    for (const std::uint32_t b : own)
      forEachEdge(blocks[b].triangles, [&](std::uint32_t low, std::uint32_t high) {
        if (low >= first && low - first < nodes) use(low - first, high);
      });
  };
  NodeEdges edges;
  std::vector<std::uint32_t>& begin = edges.begin;  // each node's end, until all are stored
  begin.assign(nodes + 1, 0);
  forEachOwn([&](std::size_t node, std::uint32_t) { ++begin[node]; });
  std::inclusive_scan(begin.begin(), begin.end(), begin.begin());
  edges.greater.resize(begin[nodes]);
  forEachOwn([&](std::size_t node, std::uint32_t high) { edges.greater[--begin[node]] = high; });
  std::uint32_t kept = 0;
  for (std::size_t node = 0; node < nodes; ++node) {
    const auto from = edges.greater.begin() + begin[node], to = edges.greater.begin() + begin[node + 1];
    std::sort(from, to);
    begin[node] = kept;
    kept += static_cast<std::uint32_t>(std::unique_copy(from, to, edges.greater.begin() + kept) -
                                       (edges.greater.begin() + kept));
  }
  begin[nodes] = kept;
  return edges;
}

}  // namespace

BulkList<Edge> uniqueEdges(std::size_t nodes, Triangles triangles, const ItemLoop& loop) {
  BulkList<Edge> edges;
  if (triangles.empty()) return edges;
  // A block is visited once for each stretch that it has an edge in: few if numbers follow the plane. If they do not,
  // stretches are made fewer and longer.
  constexpr std::size_t kMostStretches = 64, kMostVisits = 8;
  Stretches stretches{nodes, std::min(kMostStretches, std::bit_floor(nodes))};
  std::vector<Block> blocks = blocksOf(triangles, stretches, loop);
  std::vector<std::uint64_t> visits = visitsOf(blocks, stretches, loop);
  while (stretches.count > 1 && sumOf(visits) > kMostVisits * blocks.size()) {
    halve(blocks, stretches);
    visits = visitsOf(blocks, stretches, loop);
  }

  const OwnBlocks own = ownBlocks(blocks, visits);
  std::vector<BulkList<Edge>> known = widespreadEdges(blocks, stretches, own, loop);
  std::vector<NodeEdges> parts(stretches.count);
  loop(parts.size(), [&](std::size_t s) {
    parts[s] = edgesOfStretch(blocks, stretches, s, own.of(s), known[s]);
    freeMemoryOf(known[s]);
  });
  std::vector<std::size_t> before(parts.size() + 1, 0);
  for (std::size_t s = 0; s < parts.size(); ++s) before[s + 1] = before[s] + parts[s].begin.back();
  resizeAnew(loop, edges, before.back());
  loop(parts.size(), [&](std::size_t s) {
    const auto& [begin, greater] = parts[s];
    const std::size_t first = stretches.begin(s);
    std::size_t next = before[s];
    for (std::size_t node = 0; node + 1 < begin.size(); ++node)
      for (std::uint32_t i = begin[node]; i < begin[node + 1]; ++i)
        edges[next++] = {static_cast<std::uint32_t>(first + node), greater[i]};
    parts[s] = {};
  });
  return edges;
}

}  // namespace coastmesh
