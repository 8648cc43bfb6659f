#include "gis/file/gpkg_index.hpp"

#include <algorithm>
#include <bit>
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

// Whether rounding went the wrong way is as good as random, so it is no branch: the next float has the next bits.
float roundedDown(double value) {
  const auto nearest = static_cast<float>(value);
  const int step = nearest > value ? 1 : 0;
  if (nearest == 0.0f) return step == 0 ? nearest : -std::numeric_limits<float>::denorm_min();
  const auto bits = std::bit_cast<std::int32_t>(nearest);
  return std::bit_cast<float>(bits < 0 ? bits + step : bits - step);
}

float roundedUp(double value) { return -roundedDown(-value); }

}  // namespace

void GeoPackageIndex::Box::unite(const Box& other) {
  low_x = std::min(low_x, other.low_x);
  high_x = std::max(high_x, other.high_x);
  low_y = std::min(low_y, other.low_y);
  high_y = std::max(high_y, other.high_y);
}

GeoPackageIndex::Box GeoPackageIndex::outwards(const IndexBox& box) {
  return {roundedDown(box.low.x), roundedUp(box.high.x), roundedDown(box.low.y), roundedUp(box.high.y)};
}

GeoPackageIndex::GeoPackageIndex(std::uint32_t rows, const std::function<IndexBox(std::uint32_t)>& box,
                                 const ItemLoop& loop) {
  if (rows == 0) return;
  TileOrder tiles = tileOrder(rows, kCells, box, loop);
  order_ = std::move(tiles.rows);
  bounds_ = tiles.bounds;
  resizeAnew(loop, leaf_, rows);
  boxes_ = std::make_unique_for_overwrite<Box[]>(rows);
  forEachByStretches(loop, rows, [&](std::size_t i) {
    leaf_[order_[i]] = static_cast<std::uint32_t>(i / kCells);
    boxes_[i] = outwards(box(order_[i]));
  });
  // Node 1 is the root; the others are numbered from the leaves up.
  std::uint64_t next = kRoot + 1;
  for (;;) {
    const std::size_t level = levels_.size(), below = cellsBelow(level), count = (below + kCells - 1) / kCells;
    levels_.push_back({count == 1 ? kRoot : next, std::vector<Cell>(count)});
    if (count == 1) break;
    Level& made = levels_.back();
    constexpr std::size_t kWorthAStretch = 64;
    forStretches(
        loop, count,
        [&](std::size_t first, std::size_t last) {
          for (std::size_t i = first; i < last; ++i) {
            Box all = cellAt(level, i * kCells).box;
            for (std::size_t k = i * kCells + 1; k < std::min(below, (i + 1) * kCells); ++k)
              all.unite(cellAt(level, k).box);
            made.nodes[i] = {static_cast<std::int64_t>(made.first + i), all};
          }
        },
        kWorthAStretch);
    next += count;
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

// The k-th of the cells of a level's nodes.
GeoPackageIndex::Cell GeoPackageIndex::cellAt(std::size_t level, std::size_t k) const {
  if (level > 0) return levels_[level - 1].nodes[k];
  return {std::int64_t{order_[k]} + 1, boxes_[k]};
}

void GeoPackageIndex::putNode(std::uint64_t node, std::span<std::byte> bytes) const {
  const std::size_t level = levelOf(node), first = (node - levels_[level].first) * kCells;
  const std::size_t end = std::min(cellsBelow(level), first + kCells);
  std::byte* at = putBigEndian(bytes.data(), node == kRoot ? level : 0, 2);
  at = putBigEndian(at, end - first, 2);
  for (std::size_t k = first; k < end; ++k) {
    const auto& [id, box] = cellAt(level, k);
    at = putBigEndian(at, std::bit_cast<std::uint64_t>(id), 8);
    for (const float side : {box.low_x, box.high_x, box.low_y, box.high_y})
      at = putBigEndian(at, std::bit_cast<std::uint32_t>(side), 4);
  }
  std::fill(at, bytes.data() + bytes.size(), std::byte{});
}

std::uint64_t GeoPackageIndex::parentOf(std::uint64_t node) const {
  const std::size_t level = levelOf(node);
  return levels_[level + 1].first + (node - levels_[level].first) / kCells;
}

void GeoPackageIndex::addTables(const Roots& roots, std::vector<SqliteTable>& tables) const {
  if (order_.empty()) return;
  tables.push_back({roots.nodes, countOfNodes(), 1, [this](std::uint64_t i, SqliteRow& row) {
                      row.null();
                      if (const std::span<std::byte> to = row.blob(kNodeBytes); !to.empty()) putNode(i + 1, to);
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
