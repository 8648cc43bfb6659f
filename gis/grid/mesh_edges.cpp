#include "gis/grid/mesh_edges.hpp"

#include <algorithm>
#include <bit>
#include <numeric>
#include <utility>
#include <vector>

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

// Nodes are divided into stretches of consecutive numbers, whose length is a power of two. An edge belongs to the
// stretch of its lesser node.
struct Stretches {
  std::size_t nodes = 0;
  unsigned bits = 0;

  std::size_t count() const { return ((nodes - 1) >> bits) + 1; }
  std::size_t begin(std::size_t stretch) const { return std::min(stretch << bits, nodes); }
  std::size_t of(std::uint32_t node) const { return node >> bits; }
};

// So many that a core's cache holds the edges of one while they are sorted.
Stretches stretchesOf(std::size_t nodes) {
  constexpr std::size_t kMostStretches = 2048, kNodesWorthAStretch = 4096;
  const std::size_t length = std::max((nodes - 1) / kMostStretches + 1, kNodesWorthAStretch);
  return {nodes, static_cast<unsigned>(std::bit_width(length - 1))};
}

// Consecutive triangles, and a bit for each portion that one of their edges belongs to.
struct Block {
  Triangles triangles;
  std::uint8_t portions = 0;
};

// Stretches from `first` to before `last`. The edges of one portion are listed at a time: since most are there twice,
// all of them would take twice as much memory as the result.
struct Portion {
  std::size_t first = 0, last = 0;
};

std::vector<Portion> portionsOf(std::size_t stretches, std::size_t triangles) {
  constexpr std::size_t kTrianglesOfAPortion = 250'000, kMostPortions = 6;
  const std::size_t count = std::clamp<std::size_t>(triangles / kTrianglesOfAPortion, 1, kMostPortions);
  std::vector<Portion> portions(std::min(count, stretches));
  for (std::size_t p = 0; p < portions.size(); ++p)
    portions[p] = {stretches * p / portions.size(), stretches * (p + 1) / portions.size()};
  return portions;
}

std::vector<Block> blocksOf(Triangles triangles, const Stretches& stretches, const std::vector<Portion>& portions,
                            const ItemLoop& loop) {
  constexpr std::size_t kBlock = 1024;
  std::vector<std::uint8_t> bit_of(stretches.count());
  for (std::size_t p = 0; p < portions.size(); ++p)
    for (std::size_t s = portions[p].first; s < portions[p].last; ++s) bit_of[s] = static_cast<std::uint8_t>(1u << p);
  std::vector<Block> blocks((triangles.size() + kBlock - 1) / kBlock);
  const auto make = [&](std::size_t first, std::size_t last) {
    for (std::size_t b = first; b < last; ++b) {
      Block block{triangles.subspan(b * kBlock, std::min(kBlock, triangles.size() - b * kBlock)), 0};
      forEachEdge(block.triangles,
                  [&](std::uint32_t low, std::uint32_t) { block.portions |= bit_of[stretches.of(low)]; });
      blocks[b] = block;
    }
  };
  forStretches(loop, blocks.size(), make, 8);
  return blocks;
}

// The edges of a portion by stretch, in any order; those of several triangles are there several times.
struct PortionEdges {
  BulkList<Edge> edges;
  std::vector<std::size_t> begin;  // of each stretch in `edges`, then the end

  std::span<Edge> of(std::size_t stretch) {
    return std::span(edges).subspan(begin[stretch], begin[stretch + 1] - begin[stretch]);
  }
};

// Lists the edges of these blocks that belong to a portion. Counted first, so that all threads know their places.
void list(const std::vector<Triangles>& blocks, const Stretches& stretches, const Portion& portion,
          const ItemLoop& loop, PortionEdges& listed) {
  const std::size_t count = portion.last - portion.first;
  const auto forEachOwn = [&](std::size_t first, std::size_t last, const auto& use) {
    for (std::size_t b = first; b < last; ++b)
      forEachEdge(blocks[b], [&](std::uint32_t low, std::uint32_t high) {
        const std::size_t s = stretches.of(low) - portion.first;  // a large number for those before
        if (s < count) use(s, Edge{low, high});
      });
  };
  std::vector<std::vector<std::uint32_t>> places = overStretches(
      loop, blocks.size(),
      [&](std::size_t first, std::size_t last) {
        std::vector<std::uint32_t> here(count, 0);
        forEachOwn(first, last, [&](std::size_t s, const Edge&) { ++here[s]; });
        return here;
      },
      8);
  listed.begin.assign(count + 1, 0);
  forStretches(
      loop, count,
      [&](std::size_t first, std::size_t last) {
        for (std::size_t s = first; s < last; ++s) {
          std::uint32_t place = 0;
          for (std::vector<std::uint32_t>& here : places) place += std::exchange(here[s], place);
          listed.begin[s + 1] = place;
        }
      },
      8);
  std::inclusive_scan(listed.begin.begin(), listed.begin.end(), listed.begin.begin());
  resizeAnew(loop, listed.edges, listed.begin.back());
  forEachStretch(loop, blocks.size(), places.size(), [&](std::size_t r, std::size_t first, std::size_t last) {
    std::vector<std::uint32_t>& next = places[r];
    forEachOwn(first, last, [&](std::size_t s, const Edge& edge) { listed.edges[listed.begin[s] + next[s]++] = edge; });
  });
}

// Sorts edges whose lesser nodes are some from `first` on, before `last`, and drops those that repeat another; returns
// how many are left.
std::size_t sortOnce(std::span<Edge> edges, std::size_t first, std::size_t last) {
  std::vector<std::uint32_t> begin(last - first + 1, 0);  // each node's end, until all are stored
  for (const Edge& edge : edges) ++begin[edge[0] - first];
  std::inclusive_scan(begin.begin(), begin.end(), begin.begin());
  std::vector<std::uint32_t> greater(edges.size());
  for (const auto& [low, high] : edges) greater[--begin[low - first]] = high;
  std::size_t kept = 0;
  for (std::size_t node = first; node < last; ++node) {
    const auto from = greater.begin() + begin[node - first], to = greater.begin() + begin[node - first + 1];
    std::sort(from, to);
    for (auto high = from; high != to; ++high)
      if (high == from || *high != *std::prev(high)) edges[kept++] = {static_cast<std::uint32_t>(node), *high};
  }
  return kept;
}

}  // namespace

BulkList<Edge> uniqueEdges(std::size_t nodes, Triangles triangles, const ItemLoop& loop) {
  BulkList<Edge> edges;
  if (triangles.empty()) return edges;
  const Stretches stretches = stretchesOf(nodes);
  const std::vector<Portion> portions = portionsOf(stretches.count(), triangles.size());
  const std::vector<Block> blocks = blocksOf(triangles, stretches, portions, loop);
  edges.reserve(std::min(3 * triangles.size(), nodes + triangles.size() + triangles.size() / 16));  // Euler, and holes
  PortionEdges listed;
  for (std::size_t p = 0; p < portions.size(); ++p) {
    const Portion& portion = portions[p];
    std::vector<Triangles> own;
    for (const Block& block : blocks)
      if ((block.portions >> p & 1) != 0) own.push_back(block.triangles);
    list(own, stretches, portion, loop, listed);
    const std::size_t count = portion.last - portion.first;
    std::vector<std::size_t> kept(count + 1, 0);
    forItems(loop, count, [&](std::size_t s) {
      kept[s + 1] = sortOnce(listed.of(s), stretches.begin(portion.first + s), stretches.begin(portion.first + s + 1));
    });
    kept.front() = edges.size();
    std::inclusive_scan(kept.begin(), kept.end(), kept.begin());
    resizeUnset(edges, kept.back());
    forItems(loop, count, [&](std::size_t s) {
      std::ranges::copy(listed.of(s).first(kept[s + 1] - kept[s]),
                        edges.begin() + static_cast<std::ptrdiff_t>(kept[s]));
    });
  }
  return edges;
}

}  // namespace coastmesh
