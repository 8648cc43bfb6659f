#include "gis/file/gpkg_index.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace coastmesh {
namespace {

// A node of SQLite's R*Tree is a blob of fixed size: depth of the tree (in the root, else 0) and number of cells, 16
// bits each, then the cells: a row or a child as 64 bits, and least x, greatest x, least y, greatest y as 32-bit floats
// rounded outwards; all big-endian ("The SQLite R*Tree Module", and its shadow tables _node, _rowid and _parent).
constexpr std::size_t kHeaderBytes = 4, kCellBytes = 24;
constexpr std::size_t kCells = (GeoPackageIndex::kNodeBytes - kHeaderBytes) / kCellBytes;
constexpr std::uint64_t kRoot = 1;

float roundedDown(double value) {
  const auto nearest = static_cast<float>(value);
  return nearest > value ? std::nextafter(nearest, -std::numeric_limits<float>::infinity()) : nearest;
}

float roundedUp(double value) {
  const auto nearest = static_cast<float>(value);
  return nearest < value ? std::nextafter(nearest, std::numeric_limits<float>::infinity()) : nearest;
}

}  // namespace

GeoPackageIndex::GeoPackageIndex(std::uint32_t rows, std::function<IndexBox(std::uint32_t)> box, const ItemLoop& loop)
    : box_(std::move(box)) {
  if (rows == 0) return;
  TileOrder tiles = tileOrder(rows, kCells, box_, loop);
  order_ = std::move(tiles.rows);
  bounds_ = tiles.bounds;
  resizeAnew(loop, leaf_, rows);
  forEachByStretches(loop, rows, [&](std::size_t i) { leaf_[order_[i]] = static_cast<std::uint32_t>(i / kCells); });
  const auto unite = [](std::int64_t id, const std::vector<Cell>& cells) {
    Cell all{id, cells.front().box};
    for (const Cell& cell : cells)
      for (std::size_t i = 0; i < 4; ++i)
        all.box[i] = i % 2 == 0 ? std::min(all.box[i], cell.box[i]) : std::max(all.box[i], cell.box[i]);
    return all;
  };
  // Node 1 is the root; the others are numbered from the leaves up.
  std::uint64_t next = kRoot + 1;
  for (std::size_t below = rows;;) {
    const std::size_t count = (below + kCells - 1) / kCells, level = levels_.size();
    levels_.push_back({count == 1 ? kRoot : next, std::vector<Cell>(count)});
    if (count == 1) break;
    Level& made = levels_.back();
    constexpr std::size_t kWorthAStretch = 64;
    forStretches(
        loop, count,
        [&](std::size_t first, std::size_t last) {
          for (std::size_t i = first; i < last; ++i)
            made.nodes[i] = unite(static_cast<std::int64_t>(made.first + i), cellsOf(level, i));
        },
        kWorthAStretch);
    next += count;
    below = count;
  }
}

std::uint64_t GeoPackageIndex::countOfNodes() const {
  std::uint64_t count = 0;
  for (const Level& level : levels_) count += level.nodes.size();
  return count;
}

std::size_t GeoPackageIndex::levelOf(std::uint64_t node) const {
  if (node == kRoot) return levels_.size() - 1;
  std::size_t level = 0;
  while (node >= levels_[level].first + levels_[level].nodes.size()) ++level;
  return level;
}

GeoPackageIndex::Cell GeoPackageIndex::cellOf(std::uint32_t row) const {
  const IndexBox box = box_(row);
  return {std::int64_t{row} + 1,
          {roundedDown(box.low.x), roundedUp(box.high.x), roundedDown(box.low.y), roundedUp(box.high.y)}};
}

// The cells of the i-th node of a level.
std::vector<GeoPackageIndex::Cell> GeoPackageIndex::cellsOf(std::size_t level, std::uint64_t i) const {
  std::vector<Cell> cells;
  cells.reserve(kCells);
  const std::size_t below = level == 0 ? order_.size() : levels_[level - 1].nodes.size();
  for (std::size_t k = i * kCells; k < std::min<std::size_t>(below, (i + 1) * kCells); ++k)
    cells.push_back(level == 0 ? cellOf(order_[k]) : levels_[level - 1].nodes[k]);
  return cells;
}

std::array<std::byte, GeoPackageIndex::kNodeBytes> GeoPackageIndex::bytesOf(std::uint64_t node) const {
  const std::size_t level = levelOf(node);
  const std::vector<Cell> cells = cellsOf(level, node - levels_[level].first);
  std::array<std::byte, kNodeBytes> bytes{};
  std::byte* at = putBigEndian(bytes.data(), node == kRoot ? level : 0, 2);
  at = putBigEndian(at, cells.size(), 2);
  for (const Cell& cell : cells) {
    at = putBigEndian(at, std::bit_cast<std::uint64_t>(cell.id), 8);
    for (const float side : cell.box) at = putBigEndian(at, std::bit_cast<std::uint32_t>(side), 4);
  }
  return bytes;
}

std::uint64_t GeoPackageIndex::parentOf(std::uint64_t node) const {
  const std::size_t level = levelOf(node);
  return levels_[level + 1].first + (node - levels_[level].first) / kCells;
}

void GeoPackageIndex::addTables(const Roots& roots, std::vector<SqliteTable>& tables) const {
  if (order_.empty()) return;
  tables.push_back({roots.nodes, countOfNodes(), 1, [this](std::uint64_t i, SqliteRow& row) {
                      row.null();
                      if (const std::span<std::byte> to = row.blob(kNodeBytes); !to.empty())
                        std::ranges::copy(bytesOf(i + 1), to.begin());
                    }});
  tables.push_back({roots.rows, order_.size(), 1, [this](std::uint64_t i, SqliteRow& row) {
                      row.null();
                      row.whole(static_cast<std::int64_t>(levels_[0].first + leaf_[i]));
                    }});
  tables.push_back({roots.parents, countOfNodes() - 1, 2, [this](std::uint64_t i, SqliteRow& row) {
                      row.null();
                      row.whole(static_cast<std::int64_t>(parentOf(i + 2)));
                    }});
}

}  // namespace coastmesh
