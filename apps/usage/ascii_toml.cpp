#include "apps/usage/ascii_toml.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>

namespace coastmesh {

namespace {

bool isAscii(char c) { return static_cast<unsigned char>(c) < 0x80; }

struct CodePoint {
  std::uint32_t value = 0;
  std::size_t bytes = 0;
};

// The non-ASCII code point at the start; nullopt if it is not UTF-8.
std::optional<CodePoint> firstCodePoint(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text.front());
  const std::size_t bytes = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  constexpr std::uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};  // by length; below, only a shorter form is valid
  if (lead < 0xC0 || lead >= 0xF8 || text.size() < bytes) return std::nullopt;
  std::uint32_t value = lead & (0x7Fu >> bytes);
  for (const char c : text.substr(1, bytes - 1)) {
    if ((static_cast<unsigned char>(c) & 0xC0) != 0x80) return std::nullopt;
    value = value << 6 | (static_cast<unsigned char>(c) & 0x3F);
  }
  const bool surrogate = value >= 0xD800 && value <= 0xDFFF;
  if (value < kLeast[bytes] || value > 0x10FFFF || surrogate) return std::nullopt;
  return CodePoint{value, bytes};
}

class AsciiTomlWriter {
 public:
  explicit AsciiTomlWriter(std::string_view document) : document_(document) {}

  AsciiToml write() {
    if (document_.starts_with("\xEF\xBB\xBF")) at_ = 3;
    while (at_ < document_.size() && !ascii_.fault) {
      const char c = document_[at_];
      if (c == '"' || c == '\'') {
        writeText(c);
      } else if (c == '#') {
        writeComment();
      } else if (isAscii(c)) {
        if (c == '.') ++ascii_.dots;
        ascii_.text += c;
        ++at_;
      } else {
        fail("letters beyond ASCII stand in texts and comments alone");
      }
    }
    return std::move(ascii_);
  }

 private:
  void fail(std::string why) { ascii_.fault = {at_, std::move(why)}; }

  void writeComment() {
    const std::size_t end = std::min(document_.find('\n', at_), document_.size());
    for (; at_ < end; ++at_) ascii_.text += isAscii(document_[at_]) ? document_[at_] : '?';
  }

  // A string with non-ASCII letters is written in double quotes, since only these allow escapes.
  void writeText(char quote) {
    const std::size_t quotes = document_.substr(at_).starts_with(std::string(3, quote)) ? 3 : 1;
    const auto end = endOfText(quote, quotes);
    if (!end) return fail("a text does not end");
    const bool ascii = std::ranges::all_of(document_.substr(at_, *end - at_), isAscii);
    const bool literal = quote == '\'';
    const auto escapes = [&](char c) { return !ascii && literal && (c == '"' || c == '\\'); };
    ascii_.text.append(quotes, ascii ? quote : '"');
    for (at_ += quotes; at_ < *end - quotes && !ascii_.fault;) {
      const char c = document_[at_];
      if (!isAscii(c)) {
        writeEscaped();
        continue;
      }
      if (escapes(c)) ascii_.text += '\\';
      ascii_.text += c;
      ++at_;
      if (literal || c != '\\') continue;
      if (!isAscii(document_[at_])) return fail("a backslash stands before a letter beyond ASCII");
      ascii_.text += document_[at_++];
    }
    ascii_.text.append(quotes, ascii ? quote : '"');
    at_ = *end;
  }

  void writeEscaped() {
    const auto point = firstCodePoint(document_.substr(at_));
    if (!point) return fail("the text is not UTF-8");
    char escaped[16];
    std::snprintf(escaped, sizeof escaped, "\\U%08X", static_cast<unsigned>(point->value));
    ascii_.text += escaped;
    at_ += point->bytes;
  }

  // The position after the closing quotes of the string that begins here; nullopt if there are none.
  std::optional<std::size_t> endOfText(char quote, std::size_t quotes) const {
    const std::string closing(quotes, quote);
    std::size_t end = at_ + quotes;
    for (; document_.substr(end, quotes) != closing; ++end) {
      if (quote == '"' && end < document_.size() && document_[end] == '\\') ++end;
      if (end >= document_.size() || (quotes == 1 && document_[end] == '\n')) return std::nullopt;
    }
    end += quotes;
    // A string of several lines may end with up to two quotes of its own.
    for (int more = 0; quotes == 3 && more < 2 && end < document_.size() && document_[end] == quote; ++more) ++end;
    return end;
  }

  std::string_view document_;
  std::size_t at_ = 0;
  AsciiToml ascii_;
};

}  // namespace

AsciiToml toAsciiToml(std::string_view document) { return AsciiTomlWriter(document).write(); }

}  // namespace coastmesh
