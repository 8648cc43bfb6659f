#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/ids.hpp"
#include "core/item_loop.hpp"
#include "core/metric.hpp"
#include "core/point.hpp"
#include "core/size/size_box.hpp"
#include "core/size/size_places.hpp"
#include "core/size/size_tree.hpp"

namespace coastmesh {

// The cells of a size tree while it grows, with the square that each fills. Cell 0 is the root; positions are integers,
// in multiples of `unit` from the root's lower left corner.
struct SizeCells {
  static constexpr int kLevels = 24;
  static constexpr std::uint32_t kUnits = 1u << (kLevels + 1);  // per root side; leaves of the last level have centres

  struct Square {
    std::uint32_t x = 0, y = 0;  // of the lower left corner
    int level = 0;
    std::uint32_t side() const { return kUnits >> level; }
    Square child(unsigned k) const {
      const std::uint32_t half = side() / 2;
      return {x + (k % 2) * half, y + (k / 2) * half, level + 1};
    }
  };

  std::size_t count() const { return cells.size(); }
  bool isLeaf(std::uint32_t c) const { return cells[c].is_leaf; }
  // The number of a leaf, or the first of four children.
  std::uint32_t below(std::uint32_t c) const { return cells[c].below; }
  int level(std::uint32_t c) const { return squares[c].level; }
  double rootSide() const { return unit * kUnits; }

  Point placeOf(const SizePlaces::Place& place) const { return origin + Point{unit * place.x, unit * place.y}; }
  SizeBox boxOf(std::uint32_t c) const {
    const Square& s = squares[c];
    const std::uint32_t half = s.side() / 2;
    return {placeOf({s.x + half, s.y + half}), unit * half};
  }
  // The place of vertex i of a cell, numbered as in `LeafVertices`.
  SizePlaces::Place vertexOf(std::uint32_t c, unsigned i) const {
    const Square& s = squares[c];
    return {s.x + (i % 3) * (s.side() / 2), s.y + (i / 3) * (s.side() / 2)};
  }

  static constexpr unsigned kSides = 4;  // left, right, lower, upper
  // The cell beside a side of this one, as large or larger; kNone beyond the root.
  std::uint32_t beside(std::uint32_t c, unsigned side) const;
  // A leaf beside this cell that is two levels coarser or more; kNone if there is none.
  std::uint32_t tooLargeBeside(std::uint32_t c) const;

  Point origin;
  double unit = 1.0;
  std::vector<SizeTree::Cell> cells = {{}};
  std::vector<Square> squares = {{}};     // one for each cell
  std::vector<std::uint32_t> leaf_cells;  // the cell of each leaf; empty until leaves have numbers
};

// While leaves have no numbers. Splits these leaves, each once; their children follow in this order.
void splitLeaves(SizeCells& cells, std::span<const std::uint32_t> leaves, const ItemLoop& loop);
// Splits leaves until adjacent ones differ by at most one level.
void balance(SizeCells& cells, const ItemLoop& loop);

// The same when leaves have numbers. The first child takes its parent's number, the others the next ones.
void splitNumbered(SizeCells& cells, std::uint32_t c);
// REQUIRES: leaves before cell `first` are balanced.
void balanceNumbered(SizeCells& cells, std::size_t first, const ItemLoop& loop);

}  // namespace coastmesh
