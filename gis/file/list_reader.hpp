#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>

#include "gis/file/text_reader.hpp"

namespace coastmesh {

// A text file as Fortran's list-directed READ(unit, *) takes it: a statement begins in a new line that is not blank,
// goes on in the next lines until it has its values, and ignores the rest of its last line. A value may be repeated
// (2*53.0); a slash ends a statement. Errors throw InputError with the file and the line.
class ListReader {
 public:
  explicit ListReader(std::string path) : file_(std::move(path), '\0', " \t\r,;") {}

  bool nextStatement();  // false at the end of the file
  void needStatement();  // the same, for a statement that must exist
  double number();       // the statement's next value
  std::int64_t integer();
  std::uint64_t count();  // an integer that is not negative

  [[noreturn]] void fail(const std::string& what) const { file_.fail(what); }
  TextReader& text() { return file_; }
  const TextReader& text() const { return file_; }

 private:
  void begin();
  std::string_view value();

  TextReader file_;
  std::string_view repeated_;  // the value of r*value
  std::uint64_t repeats_ = 0;  // how many of them are left
  bool ended_ = false;         // a slash was read
  bool continued_ = false;     // a line had too few values for its statement
};

}  // namespace coastmesh
