#include "gis/file/sqlite_pages.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <limits>
#include <memory>

#include "gis/error.hpp"
#include "gis/file/file_parts.hpp"

namespace coastmesh {
namespace {

constexpr std::uint64_t kPage = 4096;
constexpr std::byte kLeaf{0x0D}, kInner{0x05};
constexpr std::size_t kLeafHeader = 8, kInnerHeader = 12, kPointer = 2, kChild = 4;
// SQLite's lock byte is in this page, which no table may use.
constexpr std::uint64_t kLockPage = 0x40000000 / kPage + 1;

std::size_t varintSize(std::uint64_t value) {
  return std::min<std::size_t>(9, (static_cast<std::size_t>(std::bit_width(value | 1)) + 6) / 7);
}

// Groups of seven bits, the highest first, with the top bit set in all but the last; a ninth byte has eight bits.
std::byte* putVarint(std::byte* to, std::uint64_t value) {
  if (value < 128) {
    *to = static_cast<std::byte>(value);
    return to + 1;
  }
  const std::size_t size = varintSize(value);
  std::size_t at = size;
  if (size == 9) {
    to[--at] = static_cast<std::byte>(value & 255);
    value >>= 8;
    while (at > 0) {
      to[--at] = static_cast<std::byte>((value & 127) | 128);
      value >>= 7;
    }
    return to + size;
  }
  to[--at] = static_cast<std::byte>(value & 127);
  while (at > 0) {
    value >>= 7;
    to[--at] = static_cast<std::byte>((value & 127) | 128);
  }
  return to + size;
}

std::uint64_t bigEndianAt(std::span<const std::byte> bytes, std::size_t at, unsigned count) {
  std::uint64_t value = 0;
  for (unsigned i = 0; i < count; ++i) value = value << 8 | static_cast<std::uint64_t>(bytes[at + i]);
  return value;
}

// The numbers of new pages, after those of the file.
class PageNumbers {
 public:
  explicit PageNumbers(std::uint64_t pages) : next_(pages + 1) {}

  // Takes `count` pages, skipping the lock page, and returns the number of the first; `numberOf` returns the others.
  std::uint64_t take(std::uint64_t count) {
    if (next_ == kLockPage) ++next_;
    const std::uint64_t first = next_;
    next_ = numberOf(first, count - 1) + 1;
    return first;
  }
  static std::uint64_t numberOf(std::uint64_t first, std::uint64_t i) {
    return first + i + (first < kLockPage && first + i >= kLockPage ? 1 : 0);
  }
  std::uint64_t last() const { return next_ - 1; }

 private:
  std::uint64_t next_;
};

// Fills a page: cells from its end downwards, and their offsets after the header.
class PageFiller {
 public:
  PageFiller(std::byte* page, std::byte kind, std::size_t header) : page_(page), header_(header) {
    std::fill_n(page, header, std::byte{});
    page_[0] = kind;
  }
  std::byte* cell(std::size_t size) {
    end_ -= size;
    putBigEndian(page_ + header_ + kPointer * cells_++, end_, 2);
    return page_ + end_;
  }
  void finish() {
    putBigEndian(page_ + 3, cells_, 2);
    putBigEndian(page_ + 5, end_, 2);
    const std::size_t used = header_ + kPointer * cells_;
    std::fill_n(page_ + used, end_ - used, std::byte{});
  }

 private:
  std::byte* page_;
  std::size_t header_, end_ = kPage, cells_ = 0;
};

// Rows by leaf: leaf k has those from `first_row[k]` on, and the last entry is the number of rows.
struct Leaves {
  std::vector<std::uint64_t> first_row;
  std::uint64_t first_page = 0;  // of several leaves; a single leaf is the root

  std::uint64_t count() const { return first_row.size() - 1; }
};

// Each range of rows begins a leaf, so that all ranges are laid out at the same time.
Leaves layOut(const SqliteTable& table, const std::string& path, const ItemLoop& loop) {
  const auto layOutRange = [&](std::size_t first, std::size_t last) {
    std::vector<std::uint64_t> first_rows{first};
    std::size_t used = kLeafHeader;
    SqliteRow row(SqliteRow::Keeps::Size);
    for (std::size_t i = first; i < last; ++i) {
      row.clear();
      table.make(i, row);
      const std::size_t size = row.size();
      if (size > kLargestSqliteRow)
        throw OutputError("cannot write '" + path + "': a row of " + std::to_string(size) + " bytes");
      const auto number = static_cast<std::uint64_t>(table.first) + i;
      const std::size_t cell = size + varintSize(size) + varintSize(number) + kPointer;
      if (used + cell > kPage) {
        first_rows.push_back(i);
        used = kLeafHeader;
      }
      used += cell;
    }
    return first_rows;
  };
  Leaves leaves{joined(overStretches(loop, table.rows, layOutRange)), 0};
  leaves.first_row.push_back(table.rows);
  return leaves;
}

void fillLeaf(const SqliteTable& table, const Leaves& leaves, std::uint64_t leaf, SqliteRow& row, std::byte* page) {
  PageFiller filler(page, kLeaf, kLeafHeader);
  for (std::uint64_t i = leaves.first_row[leaf]; i < leaves.first_row[leaf + 1]; ++i) {
    row.clear();
    table.make(i, row);
    const auto number = static_cast<std::uint64_t>(table.first) + i;
    const std::size_t size = row.size();
    std::byte* at = filler.cell(size + varintSize(size) + varintSize(number));
    at = putVarint(putVarint(at, size), number);
    row.copyTo(at);
  }
  filler.finish();
}

// A page, and the largest row number in its subtree.
struct Child {
  std::uint64_t page = 0, greatest = 0;
};
using Page = std::array<std::byte, kPage>;

// REQUIRES: the children fit into a page.
void fillInner(std::span<const Child> children, std::byte* page) {
  PageFiller filler(page, kInner, kInnerHeader);
  for (const Child& child : children.first(children.size() - 1)) {
    std::byte* const at = filler.cell(kChild + varintSize(child.greatest));
    putBigEndian(at, child.page, kChild);
    putVarint(at + kChild, child.greatest);
  }
  filler.finish();
  putBigEndian(page + kInnerHeader - kChild, children.back().page, kChild);
}

// The rows of a table as parts of the file.
class TableWriter {
 public:
  TableWriter(const SqliteTable& table, const std::string& path, const ItemLoop& loop, PageNumbers& numbers)
      : table_(table), leaves_(layOut(table, path, loop)) {
    if (leaves_.count() == 1) return;
    leaves_.first_page = numbers.take(leaves_.count());
    std::vector<Child> level;
    for (std::uint64_t k = 0; k < leaves_.count(); ++k)
      level.push_back({PageNumbers::numberOf(leaves_.first_page, k),
                       static_cast<std::uint64_t>(table.first) + leaves_.first_row[k + 1] - 1});
    // Children that fit into a page even if all row numbers have the full length.
    constexpr std::size_t kChildren = (kPage - kInnerHeader) / (kPointer + kChild + 9);
    while (level.size() > kChildren) {
      std::vector<Child> above;
      const std::uint64_t pages = (level.size() + kChildren - 1) / kChildren;
      const std::uint64_t first = numbers.take(pages);
      for (std::uint64_t k = 0; k < pages; ++k) {
        // In equal shares, because SQLite treats a page with a single child as corrupt.
        const std::size_t from = level.size() * k / pages, to = level.size() * (k + 1) / pages;
        const std::span<const Child> children = std::span(level).subspan(from, to - from);
        above.push_back({PageNumbers::numberOf(first, k), children.back().greatest});
        addInner(above.back().page, children);
      }
      level = std::move(above);
    }
    addInner(table.root, level);
  }

  void addParts(std::vector<FilePart>& parts) const {
    if (leaves_.count() == 1)
      parts.push_back(partOf(table_.root, 0, 1));
    else
      addLeaves(parts);
    for (const auto& [number, page] : inner_) {
      const auto fill = [&page = *page](std::uint64_t first, std::span<std::byte> bytes) {
        std::copy_n(page.begin() + static_cast<std::ptrdiff_t>(first), bytes.size(), bytes.begin());
      };
      parts.push_back({(number - 1) * kPage, kPage, fill});
    }
  }

 private:
  void addInner(std::uint64_t number, std::span<const Child> children) {
    inner_.emplace_back(number, std::make_unique<Page>());
    fillInner(children, inner_.back().second->data());
  }

  void addLeaves(std::vector<FilePart>& parts) const {
    const std::uint64_t first = leaves_.first_page, count = leaves_.count();
    const std::uint64_t before = first < kLockPage ? std::min(count, kLockPage - first) : count;
    parts.push_back(partOf(first, 0, before));
    if (before < count) parts.push_back(partOf(PageNumbers::numberOf(first, before), before, count - before));
  }

  // `count` leaves, from `leaf` on, on consecutive pages. `fill` always gets whole pages: these begin at multiples of
  // their size, of which a window of `writeParts` is a multiple too.
  FilePart partOf(std::uint64_t page, std::uint64_t leaf, std::uint64_t count) const {
    const auto fill = [this, leaf](std::uint64_t first, std::span<std::byte> bytes) {
      SqliteRow row(SqliteRow::Keeps::Values);
      for (std::uint64_t at = 0; at < bytes.size(); at += kPage)
        fillLeaf(table_, leaves_, leaf + (first + at) / kPage, row, bytes.data() + at);
    };
    return {(page - 1) * kPage, count * kPage, fill};
  }

  const SqliteTable& table_;
  Leaves leaves_;
  std::vector<std::pair<std::uint64_t, std::unique_ptr<Page>>> inner_;
};

// The header in the file's first page. Throws OutputError if it is not as expected.
struct DatabaseHeader {
  static constexpr std::size_t kBytes = 100, kPages = 28;
  std::uint64_t pages = 0;

  explicit DatabaseHeader(const std::string& path) {
    std::array<std::byte, kBytes> head{};
    std::ifstream file(path, std::ios::binary);
    file.read(reinterpret_cast<char*>(head.data()), head.size());
    constexpr std::uint64_t kSchemaFormat = 4, kUtf8 = 1;
    const bool known = file && std::memcmp(head.data(), "SQLite format 3", 16) == 0 &&
                       bigEndianAt(head, 16, 2) == kPage && head[20] == std::byte{} &&
                       bigEndianAt(head, 24, 4) == bigEndianAt(head, 92, 4) && bigEndianAt(head, 52, 4) == 0 &&
                       bigEndianAt(head, 44, 4) == kSchemaFormat && bigEndianAt(head, 56, 4) == kUtf8;
    if (!known) throw OutputError("cannot write '" + path + "': SQLite made a file of another kind than was expected");
    pages = bigEndianAt(head, kPages, 4);
  }
};

}  // namespace

void SqliteRow::longType(std::uint64_t serial) {
  if (header_size_ < kLargestSqliteRow) putVarint(header_.data() + header_size_, serial);
  header_size_ += varintSize(serial);
}

// The header's length includes its own bytes: one, or two for headers of more than 127 bytes.
std::size_t SqliteRow::size() const {
  const std::size_t own = varintSize(header_size_ + 1);
  return own + header_size_ + body_size_;
}

void SqliteRow::copyTo(std::byte* bytes) const {
  const std::size_t own = varintSize(header_size_ + 1);
  bytes = putVarint(bytes, header_size_ + own);
  bytes = std::copy_n(header_.begin(), header_size_, bytes);
  std::copy_n(body_.begin(), body_size_, bytes);
}

void writeSqliteTables(const std::string& path, const std::vector<SqliteTable>& tables, const ItemLoop& loop) {
  const DatabaseHeader header(path);
  PageNumbers numbers(header.pages);
  std::vector<std::unique_ptr<TableWriter>> writers;
  std::vector<FilePart> parts;
  for (const SqliteTable& table : tables) {
    if (table.rows == 0) continue;
    if (table.root < 2 || table.root > header.pages)
      throw OutputError("cannot write '" + path + "': a table of it begins at no page");
    writers.push_back(std::make_unique<TableWriter>(table, path, loop, numbers));
    writers.back()->addParts(parts);
  }
  if (numbers.last() > std::numeric_limits<std::uint32_t>::max() - 1)
    throw OutputError("cannot write '" + path + "': it would have more pages than SQLite counts");
  writeParts(path, std::move(parts), loop);
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  std::array<std::byte, 4> pages{};
  putBigEndian(pages.data(), std::max(header.pages, numbers.last()), 4);
  file.seekp(DatabaseHeader::kPages);
  file.write(reinterpret_cast<const char*>(pages.data()), pages.size());
  file.close();
  if (!file) throw OutputError("cannot write '" + path + "': " + std::strerror(errno));
}

}  // namespace coastmesh
