#include "gis/file/list_reader.hpp"

#include <charconv>
#include <utility>

namespace coastmesh {

void ListReader::begin() {
  repeats_ = 0;
  ended_ = false;
}

bool ListReader::nextStatement() {
  begin();
  return file_.nextLine();
}

void ListReader::needStatement() {
  begin();
  file_.needLine();
}

std::string_view ListReader::value() {
  if (repeats_ > 0) {
    --repeats_;
    return repeated_;
  }
  if (!ended_ && !file_.hasWord()) {
    if (!std::exchange(continued_, true))
      file_.addToErrors(" (line " + std::to_string(file_.lineNumber()) +
                        " has too few values, so the next line was read as a part of it)");
    file_.needLine();
  }
  std::string_view word = ended_ ? std::string_view() : file_.word();
  if (const std::size_t slash = word.find('/'); slash != word.npos) {
    word = word.substr(0, slash);
    ended_ = true;
  }
  if (word.empty()) fail("a slash ends it before all its values");
  const std::size_t star = word.find('*');
  if (star == word.npos) return word;
  std::uint64_t times = 0;
  const char* const end = word.data() + star;
  const auto [stop, error] = std::from_chars(word.data(), end, times);
  if (error != std::errc() || stop != end || times == 0 || star + 1 == word.size())
    fail("\"" + std::string(word) + "\" repeats no value");
  repeated_ = word.substr(star + 1);
  repeats_ = times - 1;
  return repeated_;
}

double ListReader::number() { return file_.numberIn(value()); }

std::int64_t ListReader::integer() { return file_.integerIn(value()); }

std::uint64_t ListReader::count() { return file_.countIn(value()); }

}  // namespace coastmesh
