#include "core/size/size_subtrees.hpp"

#include <utility>

namespace coastmesh {

namespace {

using Cells = std::span<const SizeTree::Cell>;

// Roots of subtrees, depth first, that together hold all leaves: enough for all threads, if the tree is large.
std::vector<std::uint32_t> listSubtrees(Cells cells) {
  constexpr std::size_t kEnough = 1024;
  std::vector<std::uint32_t> roots = {0}, below;
  for (bool deeper = true; deeper && roots.size() < kEnough; roots.swap(below)) {
    below.clear();
    for (const std::uint32_t c : roots) {
      if (cells[c].is_leaf) {
        below.push_back(c);
        continue;
      }
      for (std::uint32_t k = 0; k < 4; ++k) below.push_back(cells[c].below + k);
    }
    deeper = below.size() > roots.size();
  }
  return roots;
}

// Subtrees worth an item of a loop.
std::size_t subtreesAtOnce(Cells cells, const std::vector<std::uint32_t>& roots) {
  constexpr std::size_t kWorthThreads = 1 << 14, kSome = 4;
  return cells.size() < kWorthThreads ? roots.size() : kSome;
}

}  // namespace

std::vector<std::uint32_t> leavesDepthFirst(Cells cells, const ItemLoop& loop) {
  const std::vector<std::uint32_t> roots = listSubtrees(cells);
  const auto list = [&](const auto& self, std::uint32_t c, std::vector<std::uint32_t>& leaves) -> void {
    if (cells[c].is_leaf) return leaves.push_back(c);
    for (std::uint32_t k = 0; k < 4; ++k) self(self, cells[c].below + k, leaves);
  };
  const auto listBelow = [&](std::size_t first, std::size_t last) {
    std::vector<std::uint32_t> leaves;
    for (std::size_t r = first; r < last; ++r) list(list, roots[r], leaves);
    return leaves;
  };
  return joined(overStretches(loop, roots.size(), listBelow, subtreesAtOnce(cells, roots)));
}

CellOrder orderDepthFirst(Cells cells, std::size_t leaves, const ItemLoop& loop) {
  const std::vector<std::uint32_t> roots = listSubtrees(cells);
  const auto forEachRoot = [&](const auto& work) {
    const auto workOn = [&](std::size_t first, std::size_t last) {
      for (std::size_t r = first; r < last; ++r) work(r);
    };
    forStretches(loop, roots.size(), workOn, subtreesAtOnce(cells, roots));
  };
  // The cells that were split and the leaves of a subtree; later of all before it.
  struct Count {
    std::uint32_t split = 0, leaves = 0;
  };
  std::vector<Count> counts(roots.size());
  const auto count = [&](const auto& self, std::uint32_t c, Count& sum) -> void {
    if (cells[c].is_leaf) {
      ++sum.leaves;
      return;
    }
    ++sum.split;
    for (std::uint32_t k = 0; k < 4; ++k) self(self, cells[c].below + k, sum);
  };
  forEachRoot([&](std::size_t r) { count(count, roots[r], counts[r]); });

  CellOrder order{{}, unsetList<std::uint32_t>(leaves)};
  reserveOn(loop, order.cells, cells.size());
  order.cells.resize(cells.size());
  const auto layCell = [&](std::uint32_t c, std::size_t to, Count& before, const auto& layBelow) {
    const std::uint32_t below = cells[c].below;
    if (cells[c].is_leaf) {
      order.cells[to] = {before.leaves, true};
      order.leaf[below] = before.leaves++;
      return;
    }
    const std::uint32_t first = 1 + 4 * before.split++;
    order.cells[to] = {first, false};
    for (std::uint32_t k = 0; k < 4; ++k) layBelow(below + k, first + k);
  };
  // Above the roots first, which determines where each subtree begins.
  std::vector<std::size_t> to(roots.size());
  Count before;
  std::size_t next = 0;
  const auto layTop = [&](const auto& self, std::uint32_t c, std::size_t at) -> void {
    if (c != roots[next]) return layCell(c, at, before, [&](auto child, auto there) { self(self, child, there); });
    to[next] = at;
    const Count here = std::exchange(counts[next], before);
    before.split += here.split;
    before.leaves += here.leaves;
    if (next + 1 < roots.size()) ++next;
  };
  layTop(layTop, 0, 0);
  const auto lay = [&](const auto& self, std::uint32_t c, std::size_t at, Count& sum) -> void {
    layCell(c, at, sum, [&](auto child, auto there) { self(self, child, there, sum); });
  };
  forEachRoot([&](std::size_t r) { lay(lay, roots[r], to[r], counts[r]); });
  return order;
}

}  // namespace coastmesh
