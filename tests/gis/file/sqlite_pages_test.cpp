#include "gis/file/sqlite_pages.hpp"

#include <gtest/gtest.h>
#include <ogrsf_frmts.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>

#include "gis/error.hpp"
#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using testing::TemporaryFolder;

struct CloseDataset {
  void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using DatasetPtr = std::unique_ptr<GDALDataset, CloseDataset>;

std::string ask(GDALDataset& dataset, const std::string& sql) {
  OGRLayer* const result = dataset.ExecuteSQL(sql.c_str(), nullptr, nullptr);
  if (result == nullptr) return CPLGetLastErrorMsg();
  const OGRFeatureUniquePtr row(result->GetNextFeature());
  std::string value = !row ? "no row" : row->IsFieldNull(0) ? "null" : row->GetFieldAsString(0);
  dataset.ReleaseResultSet(result);
  return value;
}

std::string ask(const std::string& path, const std::string& sql) {
  GDALAllRegister();
  const DatasetPtr dataset(GDALDataset::Open(path.c_str(), GDAL_OF_VECTOR));
  return dataset ? ask(*dataset, sql) : "not open";
}

// Creates a database with an empty table `t`. Returns the root page of the table.
std::uint64_t makeEmpty(const std::string& path, const std::string& columns) {
  GDALAllRegister();
  GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("SQLite");
  const DatasetPtr dataset(driver->Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  dataset->ExecuteSQL(("CREATE TABLE t (" + columns + ")").c_str(), nullptr, nullptr);
  return std::stoull(ask(*dataset, "SELECT rootpage FROM sqlite_master WHERE name = 't'"));
}

void onThreads(std::size_t count, const std::function<void(std::size_t)>& work) {
  for (std::size_t i = count; i-- > 0;) work(i);  // any order is valid
}

TEST(SqlitePages, EveryKindOfValueIsReadBack) {
  const TemporaryFolder folder;
  const std::string path = folder / "values.sqlite";
  const std::uint64_t root = makeEmpty(path, "id INTEGER PRIMARY KEY, a, b, c");
  std::vector<std::int64_t> wholes{0, 1, 2, -1};
  for (const int bits : {7, 8, 15, 16, 23, 24, 31, 32, 47, 48, 62})
    for (const std::int64_t off : {-1, 0, 1}) {
      wholes.push_back((std::int64_t{1} << bits) + off);
      wholes.push_back(-(std::int64_t{1} << bits) + off);
    }
  wholes.push_back(std::numeric_limits<std::int64_t>::min());
  wholes.push_back(std::numeric_limits<std::int64_t>::max());
  const auto textOf = [](std::uint64_t i) { return std::string(i * 50, 'x'); };
  const SqliteTable table{root, wholes.size(), 1, [&](std::uint64_t i, SqliteRow& row) {
                            row.null();
                            row.whole(wholes[i]);
                            row.real(0.1 * static_cast<double>(i));
                            row.text(textOf(i));
                          }};
  writeSqliteTables(path, {table}, onThreads);
  EXPECT_EQ(ask(path, "PRAGMA integrity_check"), "ok");
  for (std::size_t i = 0; i < wholes.size(); ++i) {
    const std::string where = " FROM t WHERE id = " + std::to_string(i + 1);
    EXPECT_EQ(ask(path, "SELECT CAST(a AS TEXT)" + where), std::to_string(wholes[i]));
    EXPECT_EQ(ask(path, "SELECT typeof(a)" + where), "integer");
    EXPECT_EQ(ask(path, "SELECT b = 0.1 * (id - 1)" + where), "1");
    EXPECT_EQ(ask(path, "SELECT length(c)" + where), std::to_string(50 * i));
  }
}

// Tables of one page, of a root above leaves, and of two levels above leaves; row numbers take one to three bytes.
TEST(SqlitePages, TreesOfAnyDepthAreSound) {
  for (const std::uint64_t rows : {0, 1, 3, 100, 127, 128, 2000, 40000}) {
    const TemporaryFolder folder;
    const std::string path = folder / "rows.sqlite";
    const std::uint64_t root = makeEmpty(path, "id INTEGER PRIMARY KEY, a");
    constexpr std::int64_t kFirst = 2;
    const SqliteTable table{root, rows, kFirst, [](std::uint64_t i, SqliteRow& row) {
                              row.null();
                              std::ranges::fill(row.blob(i * 37 % 500), static_cast<std::byte>(i & 255));
                            }};
    writeSqliteTables(path, {table}, onThreads);
    EXPECT_EQ(ask(path, "PRAGMA integrity_check"), "ok") << rows;
    EXPECT_EQ(ask(path, "SELECT count(*) FROM t"), std::to_string(rows));
    if (rows == 0) continue;
    EXPECT_EQ(ask(path, "SELECT min(id) || ' ' || max(id) FROM t"), "2 " + std::to_string(rows + 1));
    EXPECT_EQ(ask(path, "SELECT count(*) FROM t WHERE length(a) = (id - 2) * 37 % 500"), std::to_string(rows));
    EXPECT_EQ(ask(path, "SELECT length(a) FROM t WHERE id = " + std::to_string(rows + 1)),
              std::to_string((rows - 1) * 37 % 500));
  }
}

// A page above leaves holds up to 272 of them, and at least two.
TEST(SqlitePages, LeavesOneMoreThanFillPagesMakeASoundTree) {
  for (const std::uint64_t leaves : {2, 3, 271, 272, 273, 274, 544, 545, 546, 817}) {
    const TemporaryFolder folder;
    const std::string path = folder / "rows.sqlite";
    const std::uint64_t root = makeEmpty(path, "id INTEGER PRIMARY KEY, a");
    const SqliteTable table{root, leaves, 1, [](std::uint64_t, SqliteRow& row) {
                              row.null();
                              std::ranges::fill(row.blob(3000), std::byte{1});  // two do not fit into a page
                            }};
    writeSqliteTables(path, {table}, onThreads);
    EXPECT_EQ(ask(path, "PRAGMA integrity_check"), "ok") << leaves;
    EXPECT_EQ(ask(path, "SELECT count(*) FROM t WHERE length(a) = 3000"), std::to_string(leaves));
    EXPECT_EQ(ask(path, "SELECT length(a) FROM t WHERE id = " + std::to_string(leaves)), "3000");
  }
}

// SQLite reserves the page at 1 GiB for locks. The file is extended by a hole so that it ends just before that page.
TEST(SqlitePages, ThePageOfLocksIsPassedOver) {
  constexpr std::uint64_t kPage = 4096, kLockPage = (std::uint64_t{1} << 30) / kPage + 1;
  for (const std::uint64_t before : {0, 1, 2, 6}) {
    const TemporaryFolder folder;
    const std::string path = folder / "large.sqlite";
    const std::uint64_t root = makeEmpty(path, "id INTEGER PRIMARY KEY, a"), pages = kLockPage - 1 - before;
    std::filesystem::resize_file(path, pages * kPage);
    {
      std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
      file.seekp(28);
      for (int shift = 24; shift >= 0; shift -= 8) file.put(static_cast<char>(pages >> shift & 255));
    }
    const SqliteTable table{root, 5000, 1, [](std::uint64_t i, SqliteRow& row) {
                              row.null();
                              row.whole(static_cast<std::int64_t>(3 * i));
                            }};
    writeSqliteTables(path, {table}, onThreads);
    EXPECT_GT(std::filesystem::file_size(path), kLockPage * kPage);
    EXPECT_EQ(ask(path, "SELECT count(*) FROM t WHERE a = 3 * (id - 1)"), "5000") << before;
    std::ifstream file(path, std::ios::binary);
    file.seekg(static_cast<std::streamoff>((kLockPage - 1) * kPage));
    std::string held(kPage, 'x');
    file.read(held.data(), kPage);
    EXPECT_TRUE(std::ranges::all_of(held, [](char c) { return c == 0; })) << before;
  }
}

TEST(SqlitePages, RefusesWhatItCannotWrite) {
  const TemporaryFolder folder;
  const std::string path = folder / "rows.sqlite";
  const std::uint64_t root = makeEmpty(path, "id INTEGER PRIMARY KEY, a");
  const auto rowOf = [](std::size_t size) {
    return [size](std::uint64_t, SqliteRow& row) {
      row.null();
      row.blob(size);
    };
  };
  EXPECT_THROW(writeSqliteTables(path, {{root, 1, 1, rowOf(kLargestSqliteRow)}}, onThreads), OutputError);
  EXPECT_THROW(writeSqliteTables(path, {{1, 1, 1, rowOf(10)}}, onThreads), OutputError);
  EXPECT_THROW(writeSqliteTables(path, {{1000, 1, 1, rowOf(10)}}, onThreads), OutputError);
  EXPECT_EQ(ask(path, "SELECT count(*) FROM t"), "0");
  std::ofstream(folder / "other.sqlite") << std::string(8192, 'x');
  EXPECT_THROW(writeSqliteTables(folder / "other.sqlite", {{2, 1, 1, rowOf(10)}}, onThreads), OutputError);
}

}  // namespace
}  // namespace coastmesh
