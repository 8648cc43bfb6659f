#include "apps/config_file.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <sstream>

#include "apps/command_line.hpp"

namespace coastmesh {

namespace {

using Json = nlohmann::ordered_json;

// An entry of the file; `values` are texts as a user would type them.
struct Entry {
  std::vector<std::string> sections;
  std::string name;
  std::vector<std::string> values;
};

std::string textOf(const Json& value, const std::string& file, const std::string& name) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number() || value.is_boolean()) return value.dump();
  throw UsageError(file + ": '" + name + "' is neither a text, a number, true or false, nor a list of such");
}

void collectJson(const Json& object, const std::string& file, std::vector<std::string>& sections,
                 std::vector<Entry>& entries) {
  for (const auto& [name, value] : object.items()) {
    if (value.is_null()) continue;
    if (value.is_object()) {
      sections.push_back(name);
      collectJson(value, file, sections, entries);
      sections.pop_back();
      continue;
    }
    Entry entry{sections, name, {}};
    if (value.is_array()) {
      for (const Json& element : value) entry.values.push_back(textOf(element, file, name));
    } else {
      entry.values.push_back(textOf(value, file, name));
    }
    entries.push_back(std::move(entry));
  }
}

std::vector<Entry> readJson(const std::string& file, const std::string& text) {
  std::vector<Entry> entries;
  try {
    const Json json = Json::parse(text, nullptr, true, true);
    if (!json.is_object()) throw UsageError(file + ": holds no object of options");
    std::vector<std::string> sections;
    collectJson(json, file, sections, entries);
  } catch (const Json::parse_error& error) {
    throw UsageError(file + ": not JSON, at character " + std::to_string(error.byte));
  }
  return entries;
}

// As much of TOML as options need: sections, keys, texts, numbers, true and false, and lists of these.
class TomlReader {
 public:
  TomlReader(const std::string& file, const std::string& text) : file_(file), text_(text) {}

  std::vector<Entry> read() {
    std::vector<Entry> entries;
    std::vector<std::string> sections;
    for (skip(true); at_ < text_.size(); endLine()) {
      if (text_[at_] == '[') {
        ++at_;
        sections = {key()};
        expect(']');
        continue;
      }
      Entry entry{sections, key(), {}};
      expect('=');
      skip(false);
      if (peek() == '[') {
        list(entry.values);
      } else {
        entry.values.push_back(value());
      }
      entries.push_back(std::move(entry));
    }
    return entries;
  }

 private:
  char peek() const { return at_ < text_.size() ? text_[at_] : '\n'; }

  [[noreturn]] void fail(const std::string& what) const {
    const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
    throw UsageError(file_ + ": line " + std::to_string(line) + " is not TOML that this program reads: " + what);
  }

  // Blanks and comments, and ends of lines where they do not matter.
  void skip(bool lines) {
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (c == '#') {
        while (at_ + 1 < text_.size() && text_[at_ + 1] != '\n') ++at_;
      } else if (c != ' ' && c != '\t' && c != '\r' && !(lines && c == '\n')) {
        return;
      }
    }
  }

  void endLine() {
    skip(false);
    if (peek() != '\n') fail("something follows the value");
    skip(true);
  }

  void expect(char c) {
    skip(false);
    if (peek() != c) fail(std::string("'") + c + "' is missing");
    ++at_;
  }

  static bool isBare(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_'; }

  std::string key() {
    skip(false);
    if (peek() == '"' || peek() == '\'') return quoted();
    const std::size_t first = at_;
    while (at_ < text_.size() && isBare(text_[at_])) ++at_;
    if (at_ == first) fail("a name is missing");
    return text_.substr(first, at_ - first);
  }

  std::string quoted() {
    const char quote = text_[at_++];
    std::string out;
    for (; peek() != quote; ++at_) {
      if (peek() == '\n') fail("a text does not end on its line");
      if (quote == '"' && text_[at_] == '\\') {
        ++at_;
        const std::string from = "\"\\nt", to = "\"\\\n\t";
        const std::size_t known = from.find(peek());
        if (known == std::string::npos) fail("a backslash before something else; put the text between single quotes");
        out += to[known];
      } else {
        out += text_[at_];
      }
    }
    ++at_;
    return out;
  }

  std::string value() {
    if (peek() == '"' || peek() == '\'') return quoted();
    const std::size_t first = at_;
    while (at_ < text_.size() && (isBare(text_[at_]) || text_[at_] == '.' || text_[at_] == '+')) ++at_;
    std::string bare = text_.substr(first, at_ - first);
    if (bare == "true" || bare == "false") return bare;
    std::erase(bare, '_');
    if (bare.starts_with('+')) bare.erase(0, 1);
    double number = 0.0;
    const auto [end, error] = std::from_chars(bare.data(), bare.data() + bare.size(), number);
    if (bare.empty() || error != std::errc() || end != bare.data() + bare.size())
      fail("texts stand between quotes, and '" + bare + "' is no number, true or false");
    return bare;
  }

  void list(std::vector<std::string>& values) {
    ++at_;
    for (skip(true); peek() != ']'; skip(true)) {
      if (at_ >= text_.size()) fail("a list has no closing bracket");
      values.push_back(value());
      skip(true);
      if (peek() == ',') {
        ++at_;
      } else if (peek() != ']') {
        fail("a list has no closing bracket, or no comma between two values");
      }
    }
    ++at_;
  }

  const std::string& file_;
  const std::string& text_;
  std::size_t at_ = 0;
};

std::vector<Entry> readToml(const std::string& file, const std::string& text) { return TomlReader(file, text).read(); }

std::vector<Entry> readEntries(const std::string& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw UsageError(file + ": cannot be read; --config takes a TOML or JSON file");
  std::stringstream text;
  text << stream.rdbuf();
  return file.ends_with(".json") ? readJson(file, text.str()) : readToml(file, text.str());
}

// What a command takes.
class Options {
 public:
  explicit Options(const std::string& usage) : usage_(Json::parse(usage)) {}

  std::string command() const { return usage_["command"]; }

  // By any of its names, with dashes.
  const Json* find(const std::string& name) const {
    for (const Json& option : usage_["options"])
      for (const Json& other : option["names"])
        if (other == name) return &option;
    return nullptr;
  }

  bool isArgument(std::string name) const {
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return std::ranges::any_of(usage_["arguments"], [&](const Json& a) { return a["name"] == name; });
  }

 private:
  Json usage_;
};

std::string nameOf(const std::string& argument) { return argument.substr(0, argument.find('=')); }

// Which options the user gave, by their first names; "" stands for arguments.
std::set<std::string> givenOnes(const std::vector<std::string>& arguments, const Options& options) {
  std::set<std::string> given;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const std::string& argument = arguments[i];
    if (!argument.starts_with('-') || argument == "-") {
      given.insert("");
      continue;
    }
    // "-ofile" is "-o file".
    const bool glued = !argument.starts_with("--") && argument.size() > 2;
    const Json* option = options.find(glued ? argument.substr(0, 2) : nameOf(argument));
    if (option == nullptr) continue;
    given.insert((*option)["name"].get<std::string>());
    const bool has_value = glued || argument.find('=') != std::string::npos || (*option)["type"] == "flag";
    if (!has_value) ++i;
  }
  return given;
}

std::string flagFor(const Json& option, const std::string& value, const std::string& where) {
  if (value != "true" && value != "false") throw UsageError(where + " is a switch: say true or false");
  for (const Json& name : option["names"]) {
    const std::string text = name;
    if (text.starts_with("--no-") == (value == "false")) return text;
  }
  return {};  // off already
}

}  // namespace

std::vector<std::string> expandConfig(const std::vector<std::string>& arguments, const std::string& usage) {
  const Options options(usage);
  std::optional<std::string> file;
  std::vector<std::string> expanded;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (nameOf(arguments[i]) != "--config") {
      expanded.push_back(arguments[i]);
      continue;
    }
    if (file) throw UsageError("--config is given twice; put all into one file");
    const std::size_t sign = arguments[i].find('=');
    if (sign == std::string::npos && i + 1 == arguments.size()) throw UsageError("--config needs a file");
    file = sign == std::string::npos ? arguments[++i] : arguments[i].substr(sign + 1);
  }
  if (!file) return arguments;

  const std::set<std::string> given = givenOnes(expanded, options);
  for (const Entry& entry : readEntries(*file)) {
    if (!entry.sections.empty() && (entry.sections.size() > 1 || entry.sections[0] != options.command())) {
      static const std::set<std::string> kCommands = {"mesh", "check", "info", "plot", "convert", "clean"};
      if (entry.sections.size() == 1 && kCommands.contains(entry.sections[0])) continue;
      throw UsageError(*file + ": there is no command '" + entry.sections.back() + "' to have a section of its own");
    }
    std::string name = entry.name;
    std::ranges::replace(name, '_', '-');
    const std::string where = *file + ": '" + entry.name + "'";
    if (options.isArgument(name)) {
      if (!given.contains("")) expanded.insert(expanded.end(), entry.values.begin(), entry.values.end());
      continue;
    }
    const Json* option = options.find("--" + name);
    if (option == nullptr || name == "config") {
      throw UsageError(where + " is no option of 'coastmesh " + options.command() + "'; --help lists them");
    }
    if (given.contains((*option)["name"].get<std::string>())) continue;
    if ((*option)["type"] == "flag") {
      if (entry.values.size() != 1) throw UsageError(where + " is a switch: say true or false");
      const std::string flag = flagFor(*option, entry.values[0], where);
      if (!flag.empty()) expanded.push_back(flag);
      continue;
    }
    const bool multiple = option->contains("multiple") && (*option)["multiple"].get<bool>();
    if (!multiple && entry.values.size() != 1) throw UsageError(where + " takes one value, not a list");
    for (const std::string& value : entry.values) expanded.push_back("--" + name + "=" + value);
  }
  return expanded;
}

}  // namespace coastmesh
