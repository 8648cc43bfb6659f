#include "apps/usage/config_entries.hpp"

// toml++ asserts conditions on keys ("[# a]") that it then reports as errors of the file; without asserts it lets some
// compilers assume them. Disable both.
#pragma push_macro("NDEBUG")
#undef NDEBUG
#define TOML_ASSERT(expression) static_cast<void>(0)
#include <toml++/toml.h>
#pragma pop_macro("NDEBUG")

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string_view>
#include <tuple>

#include "apps/usage/ascii_toml.hpp"
#include "gis/coast/feature_names.hpp"
#include "gis/error.hpp"

namespace coastmesh {

namespace {

using Json = nlohmann::ordered_json;

[[noreturn]] void refuseDepth(const std::string& file) {
  throw OptionError(
      sourceInWords(file) +
      ": nested deeper than options are; sections hold options, and lists hold values or lists of values");
}

[[noreturn]] void refuseValue(const std::string& file, const std::string& name) {
  throw OptionError(sourceInWords(file) + ": '" + name +
                    "' is neither a text, a number, true or false, nor a list of such");
}

[[noreturn]] void refuseTwice(const std::string& file, const std::string& name) {
  throw OptionError(sourceInWords(file) + ": '" + name + "' is given twice");
}

// JSON ------------------------------------------------------------------------------------------------------------

// Parses without recursion; throws at once if the nesting is too deep or a name is repeated.
Json parseJson(const std::string& file, const std::string& text) {
  constexpr int kDeepest = 4;  // the file, a section, a list, a list in it
  std::vector<std::set<std::string>> names;
  const auto watch = [&](int depth, Json::parse_event_t event, Json& parsed) {
    using Event = Json::parse_event_t;
    if ((event == Event::object_start || event == Event::array_start) && depth >= kDeepest) refuseDepth(file);
    if (event == Event::object_start) names.emplace_back();
    if (event == Event::object_end) names.pop_back();
    if (event == Event::key && !names.back().insert(parsed.get<std::string>()).second)
      refuseTwice(file, parsed.get<std::string>());
    return true;
  };
  try {
    Json json = Json::parse(text, watch, true, true);
    if (!json.is_object()) throw OptionError(sourceInWords(file) + ": holds no object of options");
    return json;
  } catch (const Json::parse_error& error) {
    throw OptionError(sourceInWords(file) + ": not JSON, at character " + std::to_string(error.byte));
  } catch (const Json::exception&) {
    throw OptionError(sourceInWords(file) + ": holds a number that is too large");
  }
}

std::string textOf(const Json& value, const std::string& file, const std::string& name) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number() || value.is_boolean()) return value.dump();
  refuseValue(file, name);
}

std::vector<std::string> textsOf(const Json& value, const std::string& file, const std::string& name) {
  if (!value.is_array()) return {textOf(value, file, name)};
  std::vector<std::string> texts;
  for (const Json& item : value) texts.push_back(textOf(item, file, name));
  return texts;
}

void collect(const Json& object, const std::string& file, const std::string& section,
             std::vector<ConfigEntry>& entries) {
  for (const auto& [name, value] : object.items()) {
    if (value.is_null()) continue;
    if (value.is_object()) refuseDepth(file);
    ConfigEntry entry{section, name, value.is_array(), {}};
    if (entry.list) {
      for (const Json& item : value) entry.values.push_back(textsOf(item, file, name));
    } else {
      entry.values.push_back({textOf(value, file, name)});
    }
    entries.push_back(std::move(entry));
  }
}

ConfigEntries readJson(const std::string& file, const std::string& text) {
  const Json json = parseJson(file, text);
  Json top = Json::object();
  ConfigEntries read;
  for (const auto& [name, value] : json.items())
    if (!value.is_object()) top[name] = value;
  collect(top, file, {}, read.entries);
  for (const auto& [name, value] : json.items()) {
    if (!value.is_object()) continue;
    read.sections.push_back(name);
    collect(value, file, name, read.entries);
  }
  return read;
}

// TOML ------------------------------------------------------------------------------------------------------------

std::string numberText(double number) {
  char text[40];
  const auto end = std::to_chars(text, text + sizeof text, number).ptr;
  return {text, end};
}

std::string textOf(const toml::node& value, const std::string& file, const std::string& name) {
  if (const auto* text = value.as_string()) return text->get();
  if (const auto* whole = value.as_integer()) return std::to_string(whole->get());
  if (const auto* real = value.as_floating_point()) return numberText(real->get());
  if (const auto* truth = value.as_boolean()) return truth->get() ? "true" : "false";
  refuseValue(file, name);
}

std::vector<std::string> textsOf(const toml::node& value, const std::string& file, const std::string& name) {
  if (!value.is_array()) return {textOf(value, file, name)};
  std::vector<std::string> texts;
  for (const toml::node& item : *value.as_array()) texts.push_back(textOf(item, file, name));
  return texts;
}

ConfigEntry entryOf(const toml::node& value, const std::string& file, const std::string& section,
                    const std::string& name) {
  if (value.is_table()) refuseDepth(file);
  ConfigEntry entry{section, name, value.is_array(), {}};
  if (!entry.list) {
    entry.values.push_back({textOf(value, file, name)});
    return entry;
  }
  for (const toml::node& item : *value.as_array()) {
    if (item.is_table())
      throw OptionError(sourceInWords(file) + ": '" + name + "' is a list of tables, as [[" + name +
                        "]] makes one; a job has one [" + name + "]");
    entry.values.push_back(textsOf(item, file, name));
  }
  return entry;
}

ConfigEntries readToml(const std::string& file, const std::string& text) {
  const auto refuseLine = [&](std::size_t line, std::string_view why) {
    throw OptionError(sourceInWords(file) + ": line " + std::to_string(line) + " is not TOML: " + std::string(why));
  };
  const AsciiToml ascii = toAsciiToml(text);
  if (ascii.fault)
    refuseLine(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(ascii.fault->at), '\n') + 1,
               ascii.fault->why);
  // The library frees nested tables by recursion, and dotted names nest one table per dot.
  constexpr std::size_t kMostDots = 10'000;
  if (ascii.dots > kMostDots) refuseDepth(file);
  toml::table table;
  try {
    table = toml::parse(ascii.text);
  } catch (const toml::parse_error& error) {
    refuseLine(error.source().begin.line, error.description());
  }
  // Sorted by their places in the file: the library's table does not keep the order.
  ConfigEntries read;
  std::vector<std::tuple<toml::source_position, ConfigEntry>> found;
  for (const auto& [name, value] : table) {
    const std::string section(name.str());
    if (!value.is_table()) {
      found.emplace_back(value.source().begin, entryOf(value, file, {}, section));
      continue;
    }
    read.sections.push_back(section);
    for (const auto& [inner, inner_value] : *value.as_table())
      found.emplace_back(inner_value.source().begin, entryOf(inner_value, file, section, std::string(inner.str())));
  }
  std::ranges::stable_sort(found, [](const auto& a, const auto& b) { return std::get<0>(a) < std::get<0>(b); });
  for (auto& [place, entry] : found) read.entries.push_back(std::move(entry));
  return read;
}

}  // namespace

ConfigEntries readConfigEntries(const std::string& file) {
  std::error_code error;
  std::ifstream stream(file, std::ios::binary);
  if (!stream || std::filesystem::is_directory(file, error))
    throw OptionError(sourceInWords(file) + ": cannot be read; --config takes a TOML or JSON file");
  std::stringstream text;
  text << stream.rdbuf();
  return file.ends_with(".json") ? readJson(file, text.str()) : readToml(file, text.str());
}

}  // namespace coastmesh
