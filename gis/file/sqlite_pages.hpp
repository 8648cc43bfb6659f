#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/item_loop.hpp"

namespace coastmesh {

// Writes a number's last so many bytes and gives what comes behind them.
inline std::byte* putBigEndian(std::byte* to, std::uint64_t value, unsigned bytes) {
  for (unsigned i = 0; i < bytes; ++i) *to++ = static_cast<std::byte>(value >> (8 * (bytes - 1 - i)) & 255);
  return to;
}

// A row of a table as SQLite keeps it ("Database File Format", 2.1): one value after another, in the table's order of
// columns. A column that is the row's number is null.
class SqliteRow {
 public:
  void null() { type(0); }
  void whole(std::int64_t value);
  void real(double value) {
    type(7);
    bigEndian(std::bit_cast<std::uint64_t>(value), 8);
  }
  void text(std::string_view value) {
    std::ranges::copy(std::as_bytes(std::span(value)), bytes(13 + 2 * value.size(), value.size()).begin());
  }
  std::span<std::byte> blob(std::size_t size) { return bytes(12 + 2 * size, size); }  // to be filled at once

  void clear() { header_.clear(), body_.clear(); }  // keeps its memory
  std::size_t size() const;                         // of all, with the header's own length
  void copyTo(std::byte* bytes) const;

 private:
  void type(std::uint64_t serial);
  void bigEndian(std::uint64_t value, unsigned bytes);
  std::span<std::byte> bytes(std::uint64_t serial, std::size_t size) {
    type(serial);
    body_.resize(body_.size() + size);
    return std::span(body_).last(size);
  }

  std::vector<std::byte> header_, body_;
};

// The rows of a table that is to have no others, numbered from `first` on.
struct SqliteTable {
  std::uint64_t root = 0;  // the page that the table begins in, as sqlite_master says
  std::uint64_t rows = 0;
  std::int64_t first = 1;
  std::function<void(std::uint64_t i, SqliteRow& row)> make;  // from several threads at the same time
};

// The most that a row may have, in bytes, in a file with pages of 4096; what is larger goes another way into SQLite.
inline constexpr std::size_t kLargestSqliteRow = 4000;

// Puts rows into a database that no program has open, in place of those that the tables have: their pages are made by
// all threads and written past SQLite, which takes one row after another. Not for tables with indices besides the order
// of their rows, nor for what triggers would do. Throws OutputError, also for a file that is no such database.
void writeSqliteTables(const std::string& path, const std::vector<SqliteTable>& tables, const ItemLoop& loop);

}  // namespace coastmesh
