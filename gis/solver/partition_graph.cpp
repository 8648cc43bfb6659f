#include "gis/solver/partition_graph.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <new>
#include <numeric>
#include <optional>
#include <utility>

#include "core/union_find.hpp"

// scotch.h uses FILE and is C.
extern "C" {
#include <scotch.h>
}

namespace coastmesh {
namespace {

static_assert(sizeof(SCOTCH_Num) == sizeof(std::int32_t), "MeshGraph has Scotch's integers");

// Scotch's strategy: recursive bisection, each time by the better of two multilevel bisections that are refined along
// the cut, within two percent of the mean; then vertices move between all parts, within three percent.
#define COASTMESH_BISECTION                                                                                      \
  "m{asc=b{bnd=(d{pass=40,type=b}|)f{move=120,pass=-1,bal=0.02,type=b},org=f{move=120,pass=-1,bal=0.02,type=b}," \
  "width=3},low=h{pass=10}f{move=120,pass=-1,bal=0.02,type=b},vert=120,rat=0.8}"
constexpr const char* kStrategy =
    "r{job=t,bal=0.02,map=t,poli=S,sep=(" COASTMESH_BISECTION "|" COASTMESH_BISECTION ")}f{move=500,pass=-1,bal=0.03}";
#undef COASTMESH_BISECTION

// Scotch is randomised: the best of a few attempts is better by some percent. Nearby seeds have the same result.
constexpr std::array<SCOTCH_Num, 8> kSeeds{1, 12345, 987654321, 31337, 777777777, 424242, 10000019, 271828183};

void require(int failed) {
  if (failed != 0) throw std::bad_alloc();  // the arguments are valid: it can only fail for lack of memory
}

// Owns an object of Scotch.
template <typename Object, int (*init)(Object*), void (*exit)(Object*)>
class Owned {
 public:
  Owned() { require(init(&object_)); }
  ~Owned() { exit(&object_); }
  Owned(const Owned&) = delete;
  Owned& operator=(const Owned&) = delete;
  Object* get() { return &object_; }

 private:
  Object object_{};
};
using ScotchGraph = Owned<SCOTCH_Graph, SCOTCH_graphInit, SCOTCH_graphExit>;
using ScotchStrategy = Owned<SCOTCH_Strat, SCOTCH_stratInit, SCOTCH_stratExit>;
using ScotchContext = Owned<SCOTCH_Context, SCOTCH_contextInit, SCOTCH_contextExit>;

// Single-threaded, with its own random numbers: the result depends only on the graph and the seed. Several attempts may
// run at the same time; they only read shared data.
std::vector<std::uint32_t> attemptPartition(const SCOTCH_Graph* whole, std::size_t size, std::uint32_t parts,
                                            SCOTCH_Strat* strategy, SCOTCH_Num seed) {
  ScotchContext context;
  require(SCOTCH_contextOptionSetNum(context.get(), SCOTCH_OPTIONNUMDETERMINISTIC, 1));
  require(SCOTCH_contextOptionSetNum(context.get(), SCOTCH_OPTIONNUMRANDOMFIXEDSEED, 1));
  require(SCOTCH_contextRandomClone(context.get()));
  SCOTCH_contextRandomSeed(context.get(), seed);
  SCOTCH_contextRandomReset(context.get());
  require(SCOTCH_contextThreadSpawn(context.get(), 1, nullptr));
  ScotchGraph bound;
  require(SCOTCH_contextBindGraph(context.get(), whole, bound.get()));
  std::vector<SCOTCH_Num> found(size);
  require(SCOTCH_graphPart(bound.get(), static_cast<SCOTCH_Num>(parts), strategy, found.data()));
  return {found.begin(), found.end()};
}

std::vector<std::uint64_t> sizesOf(const std::vector<std::uint32_t>& part_of, std::uint32_t parts) {
  std::vector<std::uint64_t> sizes(parts, 0);
  for (const std::uint32_t part : part_of) ++sizes[part];
  return sizes;
}

// With few vertices per part Scotch may leave parts empty, which no solver accepts: each gets a vertex of the largest.
void fillEmptyParts(std::vector<std::uint32_t>& part_of, std::uint32_t parts) {
  std::vector<std::uint64_t> sizes = sizesOf(part_of, parts);
  for (std::uint32_t empty = 0; empty < parts; ++empty) {
    if (sizes[empty] > 0) continue;
    const auto largest = static_cast<std::uint32_t>(std::ranges::max_element(sizes) - sizes.begin());
    *std::ranges::find(part_of, largest) = empty;
    --sizes[largest];
    ++sizes[empty];
  }
}

}  // namespace

PartitionFigures figuresOf(const MeshGraph& graph, const std::vector<std::uint32_t>& part_of, std::uint32_t parts) {
  PartitionFigures figures;
  std::vector<std::uint64_t> work(parts, 0);
  UnionFind joined(graph.size());
  for (std::uint32_t v = 0; v < graph.size(); ++v) {
    work[part_of[v]] += static_cast<std::uint64_t>(graph.weights[v]);
    for (std::int32_t e = graph.first[v]; e < graph.first[v + 1]; ++e) {
      const auto other = static_cast<std::uint32_t>(graph.neighbours[static_cast<std::size_t>(e)]);
      if (other < v) continue;
      if (part_of[other] == part_of[v]) {
        joined.unite(v, other);
      } else {
        ++figures.edge_cut;
      }
    }
  }
  const double mean = static_cast<double>(std::accumulate(work.begin(), work.end(), std::uint64_t{0})) / parts;
  figures.balance = static_cast<double>(std::ranges::max(work)) / mean;
  std::vector<std::uint64_t> pieces(parts, 0);
  for (std::uint32_t v = 0; v < graph.size(); ++v)
    if (joined.find(v) == v) ++pieces[part_of[v]];
  figures.connected_parts = static_cast<std::uint64_t>(std::ranges::count(pieces, std::uint64_t{1}));
  const std::vector<std::uint64_t> sizes = sizesOf(part_of, parts);
  figures.least = std::ranges::min(sizes);
  figures.most = std::ranges::max(sizes);
  return figures;
}

std::vector<std::uint32_t> partitionGraph(const MeshGraph& graph, std::uint32_t parts, const ItemLoop& loop) {
  if (parts == 1) return std::vector<std::uint32_t>(graph.size(), 0);
  ScotchGraph whole;
  require(SCOTCH_graphBuild(whole.get(), 0, static_cast<SCOTCH_Num>(graph.size()), graph.first.data(), nullptr,
                            graph.weights.data(), nullptr, static_cast<SCOTCH_Num>(graph.neighbours.size()),
                            graph.neighbours.data(), nullptr));
  ScotchStrategy strategy;
  require(SCOTCH_stratGraphMap(strategy.get(), kStrategy));  // its parser is not thread-safe
  struct Found {
    std::vector<std::uint32_t> part_of;
    PartitionFigures figures;
  };
  std::array<Found, kSeeds.size()> found;
  loop(kSeeds.size(), [&](std::size_t i) {
    found[i].part_of = attemptPartition(whole.get(), graph.size(), parts, strategy.get(), kSeeds[i]);
    fillEmptyParts(found[i].part_of, parts);
    found[i].figures = figuresOf(graph, found[i].part_of, parts);
  });
  // The smallest cut of the balanced ones; if there is none, the best balanced.
  const auto rank = [](const Found& one) {
    const double excess = std::max(one.figures.balance, kMostImbalance);
    return std::pair(excess, one.figures.edge_cut);
  };
  return std::move(std::ranges::min_element(found, {}, rank)->part_of);
}

}  // namespace coastmesh
