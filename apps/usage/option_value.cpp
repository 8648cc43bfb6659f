#include "apps/usage/option_value.hpp"

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>
#include <string_view>

namespace coastmesh {

namespace {

// The whole text as a number; spaces around it and a plus before it are allowed.
template <typename Number>
std::optional<Number> numberIn(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return number;
}

// The parts between commas; a comma at the end adds none. Uses no stream, which would treat a failed allocation as the
// end of the text.
std::vector<std::string_view> parts(std::string_view text) {
  std::vector<std::string_view> found;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(','), text.size());
    found.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return found;
}

OptionValue listIn(const std::string& text) {
  std::vector<double> list;
  for (const std::string_view part : parts(text)) {
    const std::optional<double> number = numberIn<double>(part);
    if (!number) return text;
    list.push_back(*number);
  }
  if (text.ends_with(',')) return text;
  return list;
}

}  // namespace

std::vector<std::string> namesIn(const std::string& declared) {
  std::vector<std::string> names;
  for (const std::string_view name : parts(declared)) names.emplace_back(name.substr(name.starts_with('!') ? 1 : 0));
  return names;
}

OptionValue valueOf(const std::string& text, OptionKind kind) {
  switch (kind) {
    case OptionKind::Flag:
      return text == "true";
    case OptionKind::Number:
      return numberIn<double>(text).value_or(std::numeric_limits<double>::quiet_NaN());
    case OptionKind::Integer: {
      const std::optional<std::uint64_t> number = numberIn<std::uint64_t>(text);
      if (number) return *number;
      return text;
    }
    case OptionKind::Numbers:
      return listIn(text);
    case OptionKind::Text:
    case OptionKind::File:
    case OptionKind::Choice:
      break;
  }
  return text;
}

}  // namespace coastmesh
