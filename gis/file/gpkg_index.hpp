#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "core/item_loop.hpp"
#include "gis/file/sqlite_pages.hpp"
#include "gis/file/tile_order.hpp"

namespace coastmesh {

// The spatial index of a GeoPackage's layer, built from all boxes at once, as the three tables behind SQLite's R*Tree:
// inserting rows one by one, as OGR before 3.7 does, takes five times as long as writing the features.
class GeoPackageIndex {
 public:
  // The first page of each table.
  struct Roots {
    std::uint64_t nodes = 0, rows = 0, parents = 0;
  };
  // The size of a node, in bytes, in a file with pages of 4096 bytes.
  static constexpr std::size_t kNodeBytes = 1228;

  // `box(row)`, for row < `rows`, is the box of fid row + 1; called from several threads at the same time.
  GeoPackageIndex(std::uint32_t rows, const std::function<IndexBox(std::uint32_t row)>& box, const ItemLoop& loop);

  // The box of all rows. REQUIRES: there is a row.
  const IndexBox& bounds() const { return bounds_; }

  // REQUIRES: this object outlives the tables added, and is not moved.
  void addTables(const Roots& roots, std::vector<SqliteTable>& tables) const;

 private:
  // In the precision and order of the R*Tree's cells, rounded outwards.
  struct Box {
    float low_x, high_x, low_y, high_y;

    void unite(const Box& other);
  };
  struct Cell {
    std::int64_t id;
    Box box;
  };
  struct Level {
    std::uint64_t first = 0;  // the number of its first node; others follow it
    std::vector<Cell> nodes;  // children of one parent are consecutive
  };

  static Box outwards(const IndexBox& box);
  std::size_t levelOf(std::uint64_t node) const;
  std::uint64_t countOfNodes() const;
  std::size_t cellsBelow(std::size_t level) const {
    return level == 0 ? order_.size() : levels_[level - 1].nodes.size();
  }
  Cell cellAt(std::size_t level, std::size_t k) const;
  void putNode(std::uint64_t node, std::span<std::byte> bytes) const;
  std::uint64_t parentOf(std::uint64_t node) const;

  IndexBox bounds_;
  std::vector<std::uint32_t> order_, leaf_;  // rows in the order of the leaves; the leaf of each row
  std::unique_ptr<Box[]> boxes_;             // of the rows in the order of the leaves
  std::vector<Level> levels_;                // from the leaves to the root
};

}  // namespace coastmesh
