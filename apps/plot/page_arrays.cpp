#include "apps/plot/page_arrays.hpp"

#include <cpl_conv.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <new>

namespace coastmesh {
namespace {

// Coordinates hardly compress further with more effort, which takes most of the time.
constexpr int kEffort = 4;

// `word(i)` of each of `count` values, as planes of bytes.
template <typename Word, typename WordOf>
std::vector<std::uint8_t> planesOf(std::size_t count, const WordOf& word) {
  std::vector<std::uint8_t> bytes(count * sizeof(Word));
  for (std::size_t i = 0; i < count; ++i) {
    const Word bits = word(i);
    for (std::size_t k = 0; k < sizeof(Word); ++k) bytes[k * count + i] = static_cast<std::uint8_t>(bits >> (8 * k));
  }
  return bytes;
}

std::string deflated(const std::vector<std::uint8_t>& bytes) {
  if (bytes.empty()) return {};
  std::size_t size = 0;
  const std::unique_ptr<void, void (*)(void*)> made(
      CPLZLibDeflate(bytes.data(), bytes.size(), kEffort, nullptr, 0, &size), VSIFree);
  if (!made) throw std::bad_alloc();
  return base64Of({static_cast<const std::uint8_t*>(made.get()), size});
}

}  // namespace

PackedArray packIntegers(std::span<const std::int32_t> values) {
  // Small differences of either sign get small numbers: 0, -1, 1, -2, ...
  const auto word = [values](std::size_t i) {
    const std::uint32_t before = i == 0 ? 0 : static_cast<std::uint32_t>(values[i - 1]);
    const std::uint32_t difference = static_cast<std::uint32_t>(values[i]) - before;
    return (difference << 1) ^ (difference >> 31 != 0 ? 0xffffffffu : 0u);
  };
  return {"integers", values.size(), deflated(planesOf<std::uint32_t>(values.size(), word))};
}

PackedArray packNumbers(std::span<const double> values) {
  bool short_enough = true;
  for (const double value : values) {
    // The conversion of values beyond the range of float is undefined.
    const bool fits = std::isnan(value) || (std::abs(value) <= 3e38 && static_cast<float>(value) == value);
    short_enough = short_enough && fits;
  }
  if (short_enough) {
    const auto word = [values](std::size_t i) { return std::bit_cast<std::uint32_t>(static_cast<float>(values[i])); };
    return {"singles", values.size(), deflated(planesOf<std::uint32_t>(values.size(), word))};
  }
  const auto word = [values](std::size_t i) { return std::bit_cast<std::uint64_t>(values[i]); };
  return {"doubles", values.size(), deflated(planesOf<std::uint64_t>(values.size(), word))};
}

std::string base64Of(std::span<const std::uint8_t> bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t there = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (k < there ? bytes[i + k] : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= there ? kDigits[bits >> (18 - 6 * k) & 63u] : '=';
  }
  return text;
}

}  // namespace coastmesh
