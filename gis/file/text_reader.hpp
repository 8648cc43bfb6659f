#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace coastmesh {

// Without blanks at either end.
std::string_view trimmed(std::string_view text);

// A text file, line by line and word by word; words are separated by blanks, tabs and commas, or by the characters in
// `between`. Errors throw InputError with the file and the line.
class TextReader {
 public:
  // `comment`: the rest of a line after it is ignored; '\0' for none.
  explicit TextReader(std::string path, char comment = '\0', std::string_view between = " \t\r,");

  bool nextLine();          // goes to the next line that is not blank; false at the end of the file
  void needLine();          // the same, for a line that must exist
  bool nextPhysicalLine();  // goes to the next line, blank or not; false at the end of the file
  std::string_view line() const { return line_; }

  bool hasWord();           // true if there is another word in the line
  std::string_view word();  // the next word of the line; empty at its end
  double number();          // the next word as a finite number; Fortran's exponents (1.5D+02) too
  std::int64_t integer();   // not the smallest, which has no negative
  std::uint64_t count();    // an integer that is not negative

  // The number that a word of the line is, with the same errors.
  double numberIn(std::string_view word) const;
  std::int64_t integerIn(std::string_view word) const;
  std::uint64_t countIn(std::string_view word) const;

  [[noreturn]] void fail(const std::string& what) const;
  void addToErrors(std::string remark) { remark_ = std::move(remark); }  // a possible cause, at the end of each
  const std::string& path() const { return path_; }
  std::size_t lineNumber() const { return line_number_; }  // from 1
  std::size_t size() const { return text_.size(); }        // bytes in the file: a limit for any count in the file

 private:
  bool isBetween(char c) const { return between_[static_cast<unsigned char>(c)]; }

  std::string path_;
  char comment_;
  std::array<bool, 256> between_{};  // the bytes that separate words
  std::string text_;
  std::size_t next_ = 0;  // where the next line starts
  std::size_t line_number_ = 0;
  std::string remark_;
  std::string_view line_;
  std::size_t at_ = 0;  // in the line
};

// Maps numbers of nodes or elements in a file (any, in any order) to their indices.
class IdMap {
 public:
  // `ids` in the file's order. Throws InputError, with `what` as the name of an id, if one repeats.
  IdMap(std::vector<std::int64_t> ids, const TextReader& file, std::string_view what);

  // kNone for an id that does not exist.
  std::uint32_t indexOf(std::int64_t id) const;

 private:
  // Wraps around for ids below the base, which makes it too large for any index.
  std::uint64_t fromBase(std::int64_t id) const {
    return static_cast<std::uint64_t>(id) - static_cast<std::uint64_t>(base_);
  }

  std::int64_t base_ = 0;
  std::size_t count_ = 0;
  std::vector<std::pair<std::int64_t, std::uint32_t>> sorted_;  // empty if the ids are base, base + 1, ...
};

}  // namespace coastmesh
