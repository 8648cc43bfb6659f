#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
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
  GeoPackageIndex(std::uint32_t rows, std::function<IndexBox(std::uint32_t row)> box, const ItemLoop& loop);

  // The box of all rows. REQUIRES: there is a row.
  const IndexBox& bounds() const { return bounds_; }

  // REQUIRES: this object outlives the tables added, and is not moved.
  void addTables(const Roots& roots, std::vector<SqliteTable>& tables) const;

 private:
  struct Cell {
    std::int64_t id = 0;
    std::array<float, 4> box{};
  };
  struct Level {
    std::uint64_t first = 0;  // the number of its first node; others follow it
    std::vector<Cell> nodes;  // children of one parent are consecutive
  };

  std::size_t levelOf(std::uint64_t node) const;
  std::uint64_t countOfNodes() const;
  Cell cellOf(std::uint32_t row) const;
  std::vector<Cell> cellsOf(std::size_t level, std::uint64_t i) const;
  std::array<std::byte, kNodeBytes> bytesOf(std::uint64_t node) const;
  std::uint64_t parentOf(std::uint64_t node) const;

  std::function<IndexBox(std::uint32_t)> box_;
  IndexBox bounds_;
  std::vector<std::uint32_t> order_, leaf_;  // rows in the order of the leaves; the leaf of each row
  std::vector<Level> levels_;                // from the leaves to the root
};

}  // namespace coastmesh
