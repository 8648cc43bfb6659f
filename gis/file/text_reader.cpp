#include "gis/file/text_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "core/ids.hpp"
#include "gis/error.hpp"
#include "gis/file/whole_file.hpp"

namespace coastmesh {
namespace {

std::string textOf(const std::string& path) {
  std::string text = wholeFile(path);
  if (text.empty()) throw InputError("'" + path + "' is empty");
  return text;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const std::size_t first = text.find_first_not_of(kBlanks);
  return first == std::string_view::npos ? std::string_view()
                                         : text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

TextReader::TextReader(std::string path, char comment, std::string_view between)
    : path_(std::move(path)), comment_(comment), text_(textOf(path_)) {
  for (const char c : between) between_[static_cast<unsigned char>(c)] = true;
}

bool TextReader::nextPhysicalLine() {
  line_ = {};
  at_ = 0;
  if (next_ >= text_.size()) return false;
  const std::size_t end = std::min(text_.find('\n', next_), text_.size());
  line_ = std::string_view(text_).substr(next_, end - next_);
  next_ = end + 1;
  ++line_number_;
  if (comment_ != '\0') line_ = line_.substr(0, line_.find(comment_));
  if (!line_.empty() && line_.back() == '\r') line_.remove_suffix(1);
  return true;
}

bool TextReader::nextLine() {
  while (nextPhysicalLine()) {
    if (hasWord()) return true;
  }
  return false;
}

void TextReader::needLine() {
  if (!nextLine())
    throw InputError("'" + path_ + "' ends too early, after line " + std::to_string(line_number_) + remark_);
}

bool TextReader::hasWord() {
  while (at_ < line_.size() && isBetween(line_[at_])) ++at_;
  return at_ < line_.size();
}

std::string_view TextReader::word() {
  if (!hasWord()) return {};
  std::size_t end = at_;
  while (end < line_.size() && !isBetween(line_[end])) ++end;
  const std::string_view found = line_.substr(at_, end - at_);
  at_ = end;
  return found;
}

namespace {

template <typename Number>
bool parse(std::string_view word, Number& value) {
  if (word.starts_with('+')) word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

// Fortran writes the exponents of its double precision with a D, of a higher one with a Q, and without a letter if they
// have three digits.
bool parseFortran(std::string_view word, double& value) {
  std::string text(word);
  const std::size_t at = text.find_first_of("dDqQ+-", 1);
  if (at == text.npos) return false;
  if (text[at] == '+' || text[at] == '-') {
    text.insert(at, 1, 'e');
  } else {
    text[at] = 'e';
  }
  return parse(text, value);
}

}  // namespace

double TextReader::number() { return numberIn(word()); }

double TextReader::numberIn(std::string_view text) const {
  double value = 0.0;
  if (!parse(text, value) && !parseFortran(text, value))
    fail("a number is expected, not \"" + std::string(text) + "\"");
  if (!std::isfinite(value)) fail("\"" + std::string(text) + "\" is not a finite number");
  return value;
}

std::int64_t TextReader::integer() { return integerIn(word()); }

std::int64_t TextReader::integerIn(std::string_view text) const {
  std::int64_t value = 0;
  if (!parse(text, value)) fail("a whole number is expected, not \"" + std::string(text) + "\"");
  if (value == std::numeric_limits<std::int64_t>::min()) fail(std::string(text) + " is too large a number");
  return value;
}

std::uint64_t TextReader::count() { return countIn(word()); }

std::uint64_t TextReader::countIn(std::string_view text) const {
  const std::int64_t value = integerIn(text);
  if (value < 0) fail("a count cannot be negative");
  return static_cast<std::uint64_t>(value);
}

void TextReader::fail(const std::string& what) const {
  throw InputError("'" + path_ + "', line " + std::to_string(line_number_) + ": " + what + remark_);
}

IdMap::IdMap(std::vector<std::int64_t> ids, const TextReader& file, std::string_view what) : count_(ids.size()) {
  if (ids.empty()) return;
  base_ = ids.front();
  bool ascending = true;
  for (std::size_t i = 0; i < ids.size() && ascending; ++i) ascending = fromBase(ids[i]) == i;
  if (ascending) return;
  sorted_.reserve(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) sorted_.emplace_back(ids[i], static_cast<std::uint32_t>(i));
  std::ranges::sort(sorted_);
  const auto twice =
      std::ranges::adjacent_find(sorted_, [](const auto& a, const auto& b) { return a.first == b.first; });
  if (twice != sorted_.end())
    throw InputError("'" + file.path() + "': the number of " + std::string(what) + " " + std::to_string(twice->first) +
                     " stands there twice");
}

std::uint32_t IdMap::indexOf(std::int64_t id) const {
  if (sorted_.empty()) {
    return fromBase(id) < count_ ? static_cast<std::uint32_t>(fromBase(id)) : kNone;
  }
  const auto at = std::ranges::lower_bound(sorted_, id, {}, &std::pair<std::int64_t, std::uint32_t>::first);
  return at != sorted_.end() && at->first == id ? at->second : kNone;
}

}  // namespace coastmesh
