#include "gis/file/netcdf_header.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <initializer_list>
#include <string>

#include "tests/gis/grid_samples.hpp"

namespace coastmesh {
namespace {

using testing::TemporaryFolder;

std::string integers(std::initializer_list<std::uint32_t> values) {
  std::string bytes;
  for (const std::uint32_t value : values)
    for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<char>(value >> shift));
  return bytes;
}

// A CDF-1 file without dimensions, records and variables, with one attribute of this type and number of values.
std::string withAttribute(std::uint32_t type, std::uint32_t values, const std::string& bytes) {
  return "CDF\1" + integers({0, 0, 0, 12, 1, 1}) + std::string("a\0\0\0", 4) + integers({type, values}) + bytes +
         integers({0, 0});
}

bool fits(const std::string& bytes) {
  const TemporaryFolder folder;
  std::ofstream(folder / "a.nc", std::ios::binary) << bytes;
  return headerFitsFile(folder / "a.nc");
}

TEST(HeaderFitsFile, AttributesAreOfTypesThatSuchFilesHave) {
  EXPECT_TRUE(fits(withAttribute(2, 4, "text")));
  EXPECT_TRUE(fits(withAttribute(2, 1, "t---")));  // padded
  EXPECT_TRUE(fits(withAttribute(11, 1, "12345678")));
  EXPECT_FALSE(fits(withAttribute(12, 4, "text")));
  EXPECT_FALSE(fits(withAttribute(0, 4, "text")));
}

TEST(HeaderFitsFile, NothingClaimsMoreThanTheFileHas) {
  EXPECT_FALSE(fits(withAttribute(2, 1'000'000'000, "text")));
  EXPECT_FALSE(fits(withAttribute(6, 3, "1234567812345678")));
  EXPECT_FALSE(fits(withAttribute(2, 4, "text").substr(0, 40)));
  EXPECT_TRUE(fits("CDF\3" + integers({1'000'000'000})));  // not a version of this format
  EXPECT_TRUE(fits(""));
}

// A CDF-1 file with variables of three bytes, and values as long as told: `record` of them belong to records, of which
// there are `records`.
std::string withVariables(std::uint32_t fixed, std::uint32_t record, std::uint32_t records, std::size_t bytes) {
  std::string file = "CDF\1" + integers({records, 10, 2, 1}) + std::string("t\0\0\0", 4) + integers({0, 1}) +
                     std::string("n\0\0\0", 4) + integers({3, 0, 0, 11, fixed + record});
  constexpr std::uint32_t kFixed = 9 * 4, kRecord = 10 * 4;  // bytes of the header
  const auto begin = static_cast<std::uint32_t>(file.size()) + fixed * kFixed + record * kRecord;
  for (std::uint32_t v = 0; v < fixed + record; ++v) {
    file += integers({1}) + std::string(1, static_cast<char>('a' + v)) + std::string(3, '\0');
    file += v < fixed ? integers({1, 1}) : integers({2, 0, 1});
    file += integers({0, 0, 1, 4, begin + 4 * v});  // no attributes, NC_BYTE, padded to four
  }
  return file + std::string(bytes, 'x');
}

TEST(HeaderFitsFile, NoValuesLieBeyondTheEnd) {
  const auto holds = [](std::uint32_t fixed, std::uint32_t record, std::uint32_t records, std::size_t bytes) {
    return fits(withVariables(fixed, record, records, bytes));
  };
  EXPECT_TRUE(holds(2, 0, 0, 7));  // the last may be without padding
  EXPECT_FALSE(holds(2, 0, 0, 6));
  // Records of one variable are not padded, those of several are.
  EXPECT_TRUE(holds(1, 1, 5, 4 + 15));
  EXPECT_FALSE(holds(1, 1, 5, 4 + 14));
  EXPECT_TRUE(holds(0, 2, 5, 4 * 8 + 7));
  EXPECT_FALSE(holds(0, 2, 5, 4 * 8 + 6));
  EXPECT_TRUE(holds(0, 2, 0, 0));
  EXPECT_TRUE(holds(0, 2, 0xffffffff, 0));  // the number of records of a stream is not known
  EXPECT_FALSE(holds(1, 1, 0xfffffffe, 100));
}

}  // namespace
}  // namespace coastmesh
