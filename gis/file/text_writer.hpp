#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/item_loop.hpp"

namespace coastmesh {

// Room for any number.
inline constexpr std::size_t kLongestNumber = 32;

// Writes the number to `begin`, where there is room for `kLongestNumber`, and returns its end. Doubles get the fewest
// digits that read back as the same bits, as plain decimals: exponents only below 1e-6 and from 1e15 on, since some
// readers do not take them.
inline char* writeNumber(char* begin, double value) {
  constexpr double kLeastPlain = 1e-6, kBeyondPlain = 1e15;
  const double size = std::fabs(value);
  const bool is_plain = size == 0.0 || (size >= kLeastPlain && size < kBeyondPlain);
  char* const end = begin + kLongestNumber;
  return is_plain ? std::to_chars(begin, end, value, std::chars_format::fixed).ptr
                  : std::to_chars(begin, end, value).ptr;
}
char* writeNumber(char* begin, std::integral auto value) {
  return std::to_chars(begin, begin + kLongestNumber, value).ptr;
}

// Text in memory, with numbers as in TextWriter.
class TextBlock {
 public:
  TextBlock& operator<<(std::string_view text) {
    need(text.size());
    used_ = static_cast<std::size_t>(std::ranges::copy(text, bytes_.data() + used_).out - bytes_.data());
    return *this;
  }
  TextBlock& operator<<(char c) { return *this << std::string_view(&c, 1); }
  TextBlock& operator<<(double value) { return number(value); }
  TextBlock& operator<<(std::integral auto value) requires(!std::same_as<decltype(value), char>) {
    return number(value);
  }

  // Bytes unchanged.
  void raw(const void* bytes, std::size_t size) { *this << std::string_view(static_cast<const char*>(bytes), size); }

  std::string_view text() const { return {bytes_.data(), used_}; }
  void clear() { used_ = 0; }  // keeps its memory

 private:
  void need(std::size_t size) {
    if (bytes_.size() - used_ < size) bytes_.resize(2 * bytes_.size() + size);
  }
  TextBlock& number(auto value) {
    need(kLongestNumber);
    char* const begin = bytes_.data() + used_;
    used_ += static_cast<std::size_t>(writeNumber(begin, value) - begin);
    return *this;
  }

  std::vector<char> bytes_;
  std::size_t used_ = 0;
};

// Writes a text file through a large buffer, numbers by `writeNumber`. Every failure of the system throws OutputError
// with the path and the reason.
class TextWriter {
 public:
  explicit TextWriter(std::string path);
  ~TextWriter();  // closes, but only `close` reports whether everything was written
  TextWriter(const TextWriter&) = delete;
  TextWriter& operator=(const TextWriter&) = delete;

  TextWriter& operator<<(std::string_view text);
  TextWriter& operator<<(char c) { return *this << std::string_view(&c, 1); }
  TextWriter& operator<<(double value) { return number(value); }
  TextWriter& operator<<(std::integral auto value) requires(!std::same_as<decltype(value), char>) {
    return number(value);
  }

  // Bytes unchanged, for binary parts of a file.
  void raw(const void* bytes, std::size_t size) { *this << std::string_view(static_cast<const char*>(bytes), size); }

  // Writes `row(block, i)` for every i below `count`, in this order, made block by block by the threads of `loop`.
  template <typename Row>
  void rows(const ItemLoop& loop, std::size_t count, const Row& row) {
    constexpr std::size_t kRowsABlock = 1024, kBlocksAtOnce = 64;
    std::vector<TextBlock> made, next(std::min(kBlocksAtOnce, count / kRowsABlock + 1));
    made.resize(next.size());
    flush();
    // While blocks are made, one thread writes the previous ones.
    for (std::size_t first = 0, written = 0; first < count || written > 0;) {
      const std::size_t blocks = std::min(next.size(), (count - first + kRowsABlock - 1) / kRowsABlock);
      loop(blocks + 1, [&](std::size_t b) {
        if (b == 0) {
          for (std::size_t k = 0; k < written; ++k) put(made[k].text().data(), made[k].text().size());
          return;
        }
        TextBlock& block = next[b - 1];
        block.clear();
        const std::size_t from = first + (b - 1) * kRowsABlock;
        for (std::size_t i = from; i < std::min(count, from + kRowsABlock); ++i) row(block, i);
      });
      first = std::min(count, first + blocks * kRowsABlock);
      written = blocks;
      std::swap(made, next);
    }
  }

  void close();

 private:
  TextWriter& number(auto value) {
    if (buffer_.size() - used_ < kLongestNumber) flush();
    char* const begin = buffer_.data() + used_;
    used_ += static_cast<std::size_t>(writeNumber(begin, value) - begin);
    return *this;
  }
  void flush();
  void put(const char* bytes, std::size_t size);
  void beginToFlush();

  std::string path_;
  int file_ = -1;
  std::int64_t put_ = 0, flushed_ = 0;  // bytes passed to the system; of these, sent to the disk
  std::vector<char> buffer_;
  std::size_t used_ = 0;
};

}  // namespace coastmesh
