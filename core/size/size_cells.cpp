#include "core/size/size_cells.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "core/large_list.hpp"

namespace coastmesh {

namespace {

// The cell that contains the unit square with this lower left corner, no deeper than `level`.
std::uint32_t findCell(const SizeCells& cells, std::uint32_t x, std::uint32_t y, int level) {
  std::uint32_t c = 0;
  for (int l = 1; l <= level && !cells.isLeaf(c); ++l) {
    const std::uint32_t half = SizeCells::kUnits >> l;
    c = cells.below(c) + ((x & half) != 0) + 2 * ((y & half) != 0);
  }
  return c;
}

bool isUnbalanced(const SizeCells& cells, std::uint32_t c) {
  return cells.isLeaf(c) && cells.tooLargeBeside(c) != kNone;
}

// The leaves, from cell `first` on, that have a leaf beside them that is too large.
std::vector<std::uint32_t> unbalanced(const SizeCells& cells, std::size_t first, const ItemLoop& loop) {
  return numbersWith(loop, first, cells.count(), [&](std::uint32_t c) { return isUnbalanced(cells, c); });
}

}  // namespace

std::uint32_t SizeCells::beside(std::uint32_t c, unsigned side) const {
  const Square& s = squares[c];
  const bool is_across = side < 2, is_up = side % 2 != 0;
  const std::uint32_t along = is_across ? s.x : s.y;
  // Siblings are consecutive, after the root.
  if (s.level > 0 && ((along & s.side()) != 0) != is_up) return ((c - 1) ^ (is_across ? 1u : 2u)) + 1;
  if (is_up ? along + s.side() >= kUnits : along == 0) return kNone;
  const std::uint32_t to = is_up ? along + s.side() : along - s.side();
  return is_across ? findCell(*this, to, s.y, s.level) : findCell(*this, s.x, to, s.level);
}

std::uint32_t SizeCells::tooLargeBeside(std::uint32_t c) const {
  for (unsigned side = 0; side < kSides; ++side) {
    const std::uint32_t other = beside(c, side);
    if (other != kNone && isLeaf(other) && level(other) + 1 < level(c)) return other;
  }
  return kNone;
}

void splitLeaves(SizeCells& cells, std::span<const std::uint32_t> leaves, const ItemLoop& loop) {
  const std::size_t first = cells.count(), end = first + 4 * leaves.size();
  resizeOn(loop, cells.cells, end);
  resizeOn(loop, cells.squares, end);
  forEachByStretches(loop, leaves.size(), [&](std::size_t k) {
    const std::uint32_t c = leaves[k];
    const std::size_t below = first + 4 * k;
    cells.cells[c] = {static_cast<std::uint32_t>(below), false};
    for (unsigned child = 0; child < 4; ++child) cells.squares[below + child] = cells.squares[c].child(child);
  });
}

void balance(SizeCells& cells, const ItemLoop& loop) {
  // The result is the smallest such tree, in whatever order leaves are split.
  for (std::vector<std::uint32_t> waiting = unbalanced(cells, 0, loop); !waiting.empty();) {
    auto large = listOver<std::uint32_t>(loop, waiting.size(), [&](std::size_t k, std::vector<std::uint32_t>& list) {
      if (cells.isLeaf(waiting[k])) list.push_back(cells.tooLargeBeside(waiting[k]));
    });
    sortOn(loop, large);
    large.erase(std::unique(large.begin(), large.end()), large.end());
    const std::size_t before = cells.count();
    splitLeaves(cells, large, loop);
    auto still = listOver<std::uint32_t>(loop, waiting.size(), [&](std::size_t k, std::vector<std::uint32_t>& list) {
      if (isUnbalanced(cells, waiting[k])) list.push_back(waiting[k]);
    });
    std::ranges::copy(unbalanced(cells, before, loop), std::back_inserter(still));
    waiting = std::move(still);
  }
}

void splitNumbered(SizeCells& cells, std::uint32_t c) {
  const SizeCells::Square square = cells.squares[c];
  const std::uint32_t leaf = cells.below(c);
  const auto first = static_cast<std::uint32_t>(cells.count());
  cells.cells[c] = {first, false};
  for (unsigned k = 0; k < 4; ++k) {
    cells.cells.push_back({k == 0 ? leaf : static_cast<std::uint32_t>(cells.leaf_cells.size()), true});
    cells.squares.push_back(square.child(k));
    if (k == 0)
      cells.leaf_cells[leaf] = first;
    else
      cells.leaf_cells.push_back(first + k);
  }
}

void balanceNumbered(SizeCells& cells, std::size_t first, const ItemLoop& loop) {
  // New leaves are numbered in the order in which they are made.
  std::vector<std::uint32_t> waiting = unbalanced(cells, first, loop);
  while (!waiting.empty()) {
    const std::uint32_t c = waiting.back();
    const std::uint32_t other = cells.isLeaf(c) ? cells.tooLargeBeside(c) : kNone;
    if (other == kNone) {
      waiting.pop_back();
      continue;
    }
    splitNumbered(cells, other);
    for (std::uint32_t child = 0; child < 4; ++child) waiting.push_back(cells.below(other) + child);
  }
}

}  // namespace coastmesh
