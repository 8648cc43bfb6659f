#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/item_loop.hpp"

namespace coastmesh {

// Writes the lowest `bytes` bytes of a number, 1 to 8, and returns the position after them.
inline std::byte* putBigEndian(std::byte* to, std::uint64_t value, unsigned bytes) {
  static_assert(std::endian::native == std::endian::little);
  const std::uint64_t turned = __builtin_bswap64(value) >> (64 - 8 * bytes);
  std::memcpy(to, &turned, bytes);
  return to + bytes;
}

// The maximum size of a row, in bytes, in a file with pages of 4096; larger ones are stored differently by SQLite.
inline constexpr std::size_t kLargestSqliteRow = 4000;

// A row of a table in SQLite's format ("Database File Format", 2.1): one value after another, in the table's order of
// columns. A column that is the row's number is null. If only the size is requested, texts and blobs are not stored.
class SqliteRow {
 public:
  enum class Keeps { Values, Size };

  explicit SqliteRow(Keeps keeps) : keeps_values_(keeps == Keeps::Values) {}

  void null() { type(0); }
  void whole(std::int64_t value) {
    if (value == 0 || value == 1) return type(value == 0 ? 8 : 9);
    // By the number of bytes, with the sign: the serial type, and the bytes stored.
    constexpr std::array<std::uint8_t, 9> kSerial{0, 1, 2, 3, 4, 5, 5, 6, 6}, kStored{0, 1, 2, 3, 4, 6, 6, 8, 8};
    const auto bits = static_cast<std::uint64_t>(value < 0 ? ~value : value);
    const auto bytes = static_cast<std::size_t>(std::bit_width(bits)) / 8 + 1;
    type(kSerial[bytes]);
    bigEndian(static_cast<std::uint64_t>(value), kStored[bytes]);
  }
  void real(double value) {
    type(7);
    bigEndian(std::bit_cast<std::uint64_t>(value), 8);
  }
  void text(std::string_view value) {
    const std::span<std::byte> to = bytes(13 + 2 * value.size(), value.size());
    std::ranges::copy(std::as_bytes(std::span(value)).first(to.size()), to.begin());
  }
  // To be filled at once; empty if only the size is requested.
  std::span<std::byte> blob(std::size_t size) { return bytes(12 + 2 * size, size); }

  void clear() { header_size_ = body_size_ = 0; }
  std::size_t size() const;  // of all, with the header's own length
  void copyTo(std::byte* bytes) const;

 private:
  static constexpr std::size_t kNumber = 8;  // numbers are stored as a whole, whatever their length

  void type(std::uint64_t serial) {
    if (serial >= 128) return longType(serial);
    if (header_size_ < kLargestSqliteRow) header_[header_size_] = static_cast<std::byte>(serial);
    ++header_size_;
  }
  void longType(std::uint64_t serial);
  void bigEndian(std::uint64_t value, unsigned bytes) {
    const std::uint64_t turned = __builtin_bswap64(value) >> (64 - 8 * bytes);
    if (body_size_ < kLargestSqliteRow) std::memcpy(body_.data() + body_size_, &turned, kNumber);
    body_size_ += bytes;
  }
  // The next bytes; empty if the row would be too large, or only the size is requested.
  std::span<std::byte> bytes(std::uint64_t serial, std::size_t size) {
    type(serial);
    const std::size_t at = std::exchange(body_size_, body_size_ + size);
    return keeps_values_ && body_size_ <= kLargestSqliteRow ? std::span(body_).subspan(at, size)
                                                            : std::span<std::byte>();
  }

  bool keeps_values_;
  std::size_t header_size_ = 0, body_size_ = 0;
  std::array<std::byte, kLargestSqliteRow + kNumber> header_, body_;  // set as far as used
};

// All rows of a table, numbered from `first`.
struct SqliteTable {
  std::uint64_t root = 0;  // the table's first page, from sqlite_master
  std::uint64_t rows = 0;
  std::int64_t first = 1;
  // Called from several threads at the same time; for each row first for its size, later for its values.
  std::function<void(std::uint64_t i, SqliteRow& row)> make;
};

// Replaces the rows of tables in a database that no program has open: their pages are made by all threads and written
// without SQLite, which processes one row after another. REQUIRES: a table's present rows are on its first page; it has
// no triggers, and no index other than the order of its rows. Throws OutputError, also for a file that is not such a
// database.
void writeSqliteTables(const std::string& path, const std::vector<SqliteTable>& tables, const ItemLoop& loop);

}  // namespace coastmesh
