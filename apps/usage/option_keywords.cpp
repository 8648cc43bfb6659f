#include "apps/usage/option_keywords.hpp"

#include <algorithm>
#include <cctype>
#include <map>

#include "apps/usage/option_value.hpp"

namespace coastmesh {

namespace {

bool isAlnum(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

// True if the text at `at` continues a name or a path.
bool goesOn(const std::string& text, std::size_t at) {
  if (at >= text.size()) return false;
  if (text[at] == '.') return at + 1 < text.size() && isAlnum(text[at + 1]);
  return isAlnum(text[at]) || text[at] == '-' || text[at] == '_' || text[at] == '/';
}

// The choice that follows at `at` after a space; empty if there is none.
std::string choiceAt(const std::string& text, std::size_t at, const OptionTable::Entry& entry) {
  for (const std::string& choice : entry.choices)
    if (text.compare(at, choice.size() + 1, " " + choice) == 0 && !goesOn(text, at + choice.size() + 1)) return choice;
  return {};
}

std::map<std::string, const OptionTable::Entry*> byNames(const OptionTable& table) {
  std::map<std::string, const OptionTable::Entry*> named;
  for (const OptionTable::Entry* entry : table.entries())
    if (!entry->argument)
      for (const std::string& name : namesIn(entry->names)) named.emplace(name, entry);
  return named;
}

}  // namespace

std::string keywordOf(const std::string& name) {
  std::string keyword = name.substr(std::min(name.find_first_not_of('-'), name.size()));
  std::ranges::replace(keyword, '-', '_');
  return keyword;
}

std::optional<KeywordOption> optionOf(const std::string& keyword, const OptionTable& table) {
  for (const OptionTable::Entry* entry : table.entries()) {
    if (entry->argument) continue;
    if (keywordOf(entry->name) == keyword) return KeywordOption{entry, false};
    if (!entry->former_names.empty() && keywordOf(entry->former_names.front().first) == keyword)
      return KeywordOption{entry, true};
  }
  return std::nullopt;
}

std::string inKeywords(const std::string& message, const OptionTable& table) {
  const std::map<std::string, const OptionTable::Entry*> named = byNames(table);
  std::string text;
  for (std::size_t at = 0; at < message.size();) {
    const bool begins = message.compare(at, 2, "--") == 0 && (at == 0 || !goesOn(message, at - 1));
    std::size_t end = at;
    while (begins && end < message.size() && (isAlnum(message[end]) || message[end] == '-')) ++end;
    const auto found = begins && !goesOn(message, end) ? named.find(message.substr(at, end - at)) : named.end();
    if (found == named.end()) {
      text += message[at++];
      continue;
    }
    const OptionTable::Entry& entry = *found->second;
    text += keywordOf(entry.name);
    if (found->first.starts_with("--no-")) text += "=False";
    const std::string choice = choiceAt(message, end, entry);
    if (!choice.empty()) text += "='" + choice + "'";
    at = end + (choice.empty() ? 0 : choice.size() + 1);
  }
  return text;
}

}  // namespace coastmesh
