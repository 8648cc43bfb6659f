#include "gis/file/gpkg_index.hpp"

#include <ogrsf_frmts.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace coastmesh {
namespace {

// A node of SQLite's R*Tree is a blob of fixed size: depth of the tree (in the root, else 0) and number of cells, 16
// bits each, then the cells: a row or a child as 64 bits, and least x, greatest x, least y, greatest y as 32-bit floats
// rounded outwards; all big-endian ("The SQLite R*Tree Module", and its shadow tables _node, _rowid and _parent).
constexpr std::size_t kHeaderBytes = 4, kCellBytes = 24;

struct Cell {
  std::int64_t id = 0;
  std::array<float, 4> box{};
};

float roundedDown(double value) {
  const auto nearest = static_cast<float>(value);
  return nearest > value ? std::nextafter(nearest, -std::numeric_limits<float>::infinity()) : nearest;
}

float roundedUp(double value) {
  const auto nearest = static_cast<float>(value);
  return nearest < value ? std::nextafter(nearest, std::numeric_limits<float>::infinity()) : nearest;
}

Cell unite(std::int64_t id, std::span<const Cell> cells) {
  Cell all{id, cells.front().box};
  for (const Cell& cell : cells)
    for (std::size_t i = 0; i < 4; ++i)
      all.box[i] = i % 2 == 0 ? std::min(all.box[i], cell.box[i]) : std::max(all.box[i], cell.box[i]);
  return all;
}

void appendHex(std::string& sql, std::uint64_t value, int bytes) {
  constexpr char kHex[] = "0123456789ABCDEF";
  for (int shift = 8 * bytes - 4; shift >= 0; shift -= 4) sql += kHex[value >> shift & 15];
}

void appendNode(std::string& sql, std::size_t depth, std::span<const Cell> cells, std::size_t node_bytes) {
  sql += "X'";
  appendHex(sql, depth, 2);
  appendHex(sql, cells.size(), 2);
  for (const Cell& cell : cells) {
    appendHex(sql, std::bit_cast<std::uint64_t>(cell.id), 8);
    for (const float side : cell.box) appendHex(sql, std::bit_cast<std::uint32_t>(side), 4);
  }
  sql.append(2 * (node_bytes - kHeaderBytes - cells.size() * kCellBytes), '0');
  sql += '\'';
}

// Sort-tile-recursive order (Leutenegger, Lopez & Edgington 1997): slices of x, each sorted by y, so that consecutive
// entries make compact nodes. Sums of sides stand for middles.
void sortIntoTiles(std::vector<IndexEntry>& entries, std::size_t per_node) {
  const auto by = [](double Point::*side) {
    return [side](const IndexEntry& a, const IndexEntry& b) {
      const double first = a.low.*side + a.high.*side, second = b.low.*side + b.high.*side;
      return first < second || (first == second && a.fid < b.fid);
    };
  };
  const double nodes = std::ceil(static_cast<double>(entries.size()) / static_cast<double>(per_node));
  const std::size_t slice = static_cast<std::size_t>(std::ceil(std::sqrt(nodes))) * per_node;
  std::ranges::sort(entries, by(&Point::x));
  for (std::size_t at = 0; at < entries.size(); at += slice)
    std::sort(entries.begin() + static_cast<std::ptrdiff_t>(at),
              entries.begin() + static_cast<std::ptrdiff_t>(std::min(at + slice, entries.size())), by(&Point::y));
}

// Rows of one table, sent many at once.
class RowBatch {
 public:
  explicit RowBatch(const std::string& table) : start_("INSERT INTO \"" + table + "\" VALUES ") {}

  std::string& next() {
    sql_ += sql_.empty() ? start_ : ",";
    return sql_;
  }
  bool isFull() const { return sql_.size() > 250'000; }  // bytes; SQLite takes a million at least
  std::string take() { return std::exchange(sql_, {}); }

 private:
  std::string start_;
  std::string sql_;
};

}  // namespace

GeoPackageIndex::GeoPackageIndex(GDALDataset& dataset, const std::string& layer, const std::string& geometry_column)
    : dataset_(dataset), layer_(layer), column_(geometry_column), index_("rtree_" + layer + "_" + geometry_column) {}

bool GeoPackageIndex::run(const std::string& sql) {
  if (sql.empty()) return true;
  CPLErrorReset();
  if (OGRLayer* const result = dataset_.ExecuteSQL(sql.c_str(), nullptr, nullptr)) dataset_.ReleaseResultSet(result);
  return CPLGetLastErrorType() < CE_Failure;
}

std::string GeoPackageIndex::ask(const std::string& sql) {
  OGRLayer* const result = dataset_.ExecuteSQL(sql.c_str(), nullptr, nullptr);
  if (result == nullptr) return {};
  const OGRFeatureUniquePtr row(result->GetNextFeature());
  std::string value = row && row->GetFieldCount() > 0 ? row->GetFieldAsString(0) : "";
  dataset_.ReleaseResultSet(result);
  return value;
}

bool GeoPackageIndex::create() {
  if (ask("SELECT CreateSpatialIndex('" + layer_ + "', '" + column_ + "')") != "1") return false;
  const std::string trigger = index_ + "_insert";
  insert_trigger_ = ask("SELECT sql FROM sqlite_master WHERE type = 'trigger' AND name = '" + trigger + "'");
  return !insert_trigger_.empty() && run("DROP TRIGGER \"" + trigger + "\"");
}

bool GeoPackageIndex::fill(std::vector<IndexEntry> entries) {
  const std::string length = ask("SELECT length(data) FROM \"" + index_ + "_node\" WHERE nodeno = 1");
  std::size_t node_bytes = 0;
  std::from_chars(length.data(), length.data() + length.size(), node_bytes);
  if (node_bytes < kHeaderBytes + 2 * kCellBytes) return false;
  const std::size_t per_node = (node_bytes - kHeaderBytes) / kCellBytes;

  sortIntoTiles(entries, per_node);
  std::vector<Cell> cells;
  cells.reserve(entries.size());
  for (const IndexEntry& entry : entries)
    cells.push_back(
        {entry.fid,
         {roundedDown(entry.low.x), roundedUp(entry.high.x), roundedDown(entry.low.y), roundedUp(entry.high.y)}});

  // Node 1 is the root; the others are numbered from the leaves up.
  RowBatch nodes(index_ + "_node"), rows(index_ + "_rowid"), parents(index_ + "_parent");
  std::int64_t last_node = 1;
  std::size_t depth = 0;
  const auto noteWhere = [&](std::span<const Cell> children, std::int64_t node) {
    RowBatch& batch = depth == 0 ? rows : parents;
    for (const Cell& child : children)
      batch.next() += "(" + std::to_string(child.id) + "," + std::to_string(node) + ")";
    return !batch.isFull() || run(batch.take());
  };
  for (; cells.size() > per_node; ++depth) {
    std::vector<Cell> above;
    for (std::size_t at = 0; at < cells.size(); at += per_node) {
      const std::span<const Cell> children = std::span(cells).subspan(at, std::min(per_node, cells.size() - at));
      const std::int64_t node = ++last_node;
      std::string& sql = nodes.next();
      sql += "(" + std::to_string(node) + ",";
      appendNode(sql, 0, children, node_bytes);
      sql += ")";
      if (nodes.isFull() && !run(nodes.take())) return false;
      if (!noteWhere(children, node)) return false;
      above.push_back(unite(node, children));
    }
    cells = std::move(above);
  }
  if (!noteWhere(cells, 1)) return false;
  std::string root = "UPDATE \"" + index_ + "_node\" SET data = ";
  appendNode(root, depth, cells, node_bytes);
  return run(root + " WHERE nodeno = 1") && run(nodes.take()) && run(rows.take()) && run(parents.take()) &&
         run(insert_trigger_);
}

}  // namespace coastmesh
