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

}  // namespace
}  // namespace coastmesh
