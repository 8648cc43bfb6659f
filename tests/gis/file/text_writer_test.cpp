#include "gis/file/text_writer.hpp"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>
#include <string>
#include <utility>

namespace coastmesh {
namespace {

std::string written(auto value) {
  std::array<char, kLongestNumber> text{};
  return {text.data(), writeNumber(text.data(), value)};
}

// Readers that are not Fortran's may not know 2e+05.
TEST(TextWriter, NumbersArePlainDecimals) {
  const std::array<std::pair<double, const char*>, 12> expected{
      {{200000.0, "200000"},
       {-1e5, "-100000"},
       {1e14, "100000000000000"},
       {0.0001, "0.0001"},
       {-1e-6, "-0.000001"},
       {0.1, "0.1"},
       {-73.25, "-73.25"},
       {5000000.5, "5000000.5"},
       {0.0, "0"},
       {1e15, "1e+15"},
       {9e-7, "9e-07"},
       {std::numeric_limits<double>::max(), "1.7976931348623157e+308"}}};
  for (const auto& [value, text] : expected) EXPECT_EQ(written(value), text);
  EXPECT_EQ(written(std::uint32_t{100000}), "100000");
  TextBlock block;
  block << 3e5 << ' ' << -7;
  EXPECT_EQ(block.text(), "300000 -7");
}

TEST(TextWriter, NumbersReadBackAsTheSameBits) {
  std::mt19937_64 random(20);
  for (int i = 0; i < 100000; ++i) {
    // Of any size around those written as plain decimals; 53 random bits.
    const double fraction = static_cast<double>(static_cast<std::int64_t>(random())) / 0x1p63;
    const double scaled = std::ldexp(fraction, static_cast<int>(random() % 90) - 30);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(std::strtod(written(scaled).c_str(), nullptr)),
              std::bit_cast<std::uint64_t>(scaled));
  }
}

}  // namespace
}  // namespace coastmesh
