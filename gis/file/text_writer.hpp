#pragma once

#include <charconv>
#include <concepts>
#include <string>
#include <string_view>
#include <vector>

namespace coastmesh {

// Writes a text file through a large buffer. Doubles take the fewest digits that read back as the same bits. Every
// failure of the system throws OutputError with the path and the reason.
class TextWriter {
 public:
  explicit TextWriter(std::string path);
  ~TextWriter();  // closes, but only `close` says whether all was written
  TextWriter(const TextWriter&) = delete;
  TextWriter& operator=(const TextWriter&) = delete;

  TextWriter& operator<<(std::string_view text);
  TextWriter& operator<<(char c) { return *this << std::string_view(&c, 1); }
  TextWriter& operator<<(double value) { return number(value); }
  TextWriter& operator<<(std::integral auto value) requires(!std::same_as<decltype(value), char>) {
    return number(value);
  }

  // Bytes as they are, for binary parts of a file.
  void raw(const void* bytes, std::size_t size) { *this << std::string_view(static_cast<const char*>(bytes), size); }

  void close();

 private:
  static constexpr std::size_t kLongestNumber = 32;

  TextWriter& number(auto value) {
    if (buffer_.size() - used_ < kLongestNumber) flush();
    char* const begin = buffer_.data() + used_;
    used_ += static_cast<std::size_t>(std::to_chars(begin, begin + kLongestNumber, value).ptr - begin);
    return *this;
  }
  void flush();
  void put(const char* bytes, std::size_t size);

  std::string path_;
  int file_ = -1;
  std::vector<char> buffer_;
  std::size_t used_ = 0;
};

}  // namespace coastmesh
