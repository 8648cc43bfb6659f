#include "apps/plot/page_arrays.hpp"

#include <cpl_conv.h>
#include <cpl_string.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace coastmesh::test {
namespace {

std::vector<std::uint8_t> bytesOf(const std::string& text) { return {text.begin(), text.end()}; }

// Decodes as a browser does, by other means: GDAL's base64 and zlib.
std::vector<std::uint8_t> unpacked(const PackedArray& packed, std::size_t size) {
  std::string text = packed.text;
  text += '\0';
  const int count = CPLBase64DecodeInPlace(reinterpret_cast<GByte*>(text.data()));
  std::vector<std::uint8_t> bytes(packed.count * size);
  std::size_t made = 0;
  EXPECT_NE(CPLZLibInflate(text.data(), static_cast<std::size_t>(count), bytes.data(), bytes.size(), &made), nullptr);
  EXPECT_EQ(made, bytes.size());
  return bytes;
}

TEST(PageArrays, Base64IsThatOfItsStandard) {
  // RFC 4648, section 10.
  const std::vector<std::string> texts{"", "f", "fo", "foo", "foob", "fooba", "foobar"};
  const std::vector<std::string> coded{"", "Zg==", "Zm8=", "Zm9v", "Zm9vYg==", "Zm9vYmE=", "Zm9vYmFy"};
  for (std::size_t i = 0; i < texts.size(); ++i) EXPECT_EQ(base64Of(bytesOf(texts[i])), coded[i]);
}

TEST(PageArrays, IntegersComeBack) {
  const std::vector<std::int32_t> values{
      0, 1, -1, 7, std::numeric_limits<std::int32_t>::max(), -5, 12, 12, std::numeric_limits<std::int32_t>::min()};
  const PackedArray packed = packIntegers(values);
  EXPECT_EQ(packed.form, "integers");
  ASSERT_EQ(packed.count, values.size());
  const std::vector<std::uint8_t> planes = unpacked(packed, 4);
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 4; ++k) word |= std::uint32_t{planes[k * values.size() + i]} << (8 * k);
    value += word >> 1 ^ (0u - (word & 1u));
    EXPECT_EQ(static_cast<std::int32_t>(value), values[i]) << i;
  }
}

TEST(PageArrays, NumbersComeBackBitForBit) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const std::vector<double>& values :
       {std::vector<double>{0.5, -2.0, nan, 0x1p100}, {0.1, -7.25, nan, 1e300, 1e-310}}) {
    const PackedArray packed = packNumbers(values);
    ASSERT_EQ(packed.count, values.size());
    const bool doubles = packed.form == "doubles";
    EXPECT_EQ(doubles, values[0] == 0.1);
    const std::size_t size = doubles ? 8 : 4;
    const std::vector<std::uint8_t> planes = unpacked(packed, size);
    for (std::size_t i = 0; i < values.size(); ++i) {
      std::uint64_t word = 0;
      for (std::size_t k = 0; k < size; ++k) word |= std::uint64_t{planes[k * values.size() + i]} << (8 * k);
      const double value =
          doubles ? std::bit_cast<double>(word) : std::bit_cast<float>(static_cast<std::uint32_t>(word));
      if (std::isnan(values[i])) {
        EXPECT_TRUE(std::isnan(value));
      } else {
        EXPECT_EQ(value, values[i]);
      }
    }
  }
}

TEST(PageArrays, NoneAreNoText) {
  EXPECT_EQ(packIntegers({}).text, "");
  EXPECT_EQ(packNumbers({}).text, "");
}

}  // namespace
}  // namespace coastmesh::test
