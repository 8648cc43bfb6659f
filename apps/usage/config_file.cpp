#include "apps/usage/config_file.hpp"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <optional>

#include "apps/usage/config_entries.hpp"
#include "gis/error.hpp"

namespace coastmesh {

namespace {

using Json = nlohmann::ordered_json;

// What a command takes.
class Options {
 public:
  explicit Options(const std::string& usage) : usage_(Json::parse(usage)) {}

  std::string command() const { return usage_["command"]; }

  // By any of its names, former ones too, with dashes.
  const Json* find(const std::string& name) const {
    for (const Json& option : usage_["options"]) {
      if (isFormer(option, name)) return &option;
      for (const Json& other : option["names"])
        if (other == name) return &option;
    }
    return nullptr;
  }

  static bool isFormer(const Json& option, const std::string& name) {
    return option.contains("former_names") && option["former_names"].contains(name);
  }

  bool isArgument(std::string name) const {
    std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
    return std::ranges::any_of(usage_["arguments"], [&](const Json& a) { return a["name"] == name; });
  }

 private:
  Json usage_;
};

std::string nameOf(const std::string& argument) { return argument.substr(0, argument.find('=')); }

// The place of "--", from which on all are arguments, or the end.
std::size_t endOfOptions(const std::vector<std::string>& arguments) {
  return static_cast<std::size_t>(std::ranges::find(arguments, "--") - arguments.begin());
}

// Which options the user gave, by their first names; "" stands for arguments.
std::set<std::string> givenOnes(const std::vector<std::string>& arguments, const Options& options) {
  std::set<std::string> given;
  const std::size_t end = endOfOptions(arguments);
  if (end + 1 < arguments.size()) given.insert("");
  for (std::size_t i = 0; i < end; ++i) {
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

// The switch that `name` and `value` ask for: "no-coarsen" and "true" are "--no-coarsen". Empty: it is off already.
std::string flagFor(const Json& option, const std::string& name, const std::string& value, const std::string& where) {
  if (value != "true" && value != "false") throw OptionError(where + " is a switch: say true or false");
  const bool on = (value == "true") != name.starts_with("no-");
  // A former name stays one: whoever parses the arguments warns of it.
  std::vector<std::string> names;
  if (Options::isFormer(option, "--" + name)) {
    for (const auto& former : option["former_names"].items()) names.push_back(former.key());
  } else {
    names = option["names"];
  }
  const auto wanted = std::ranges::find_if(names, [on](const auto& text) { return text.starts_with("--no-") != on; });
  return wanted == names.end() ? std::string{} : *wanted;
}

// The values as the command line would have them: a list for an option that takes several, and for one that takes
// numbers with commas between them the list of these.
std::vector<std::string> valuesFor(const Json& option, const ConfigEntry& entry, const std::string& where) {
  const std::string unit = option.value("unit", "");
  const auto parts = static_cast<std::size_t>(1 + std::ranges::count(unit, ','));
  const bool multiple = option.value("multiple", false);
  const auto joined = [](const std::vector<std::string>& texts) {
    std::string text;
    for (const std::string& part : texts) text += (text.empty() ? "" : ",") + part;
    return text;
  };
  std::vector<std::vector<std::string>> values = entry.values;
  const auto isPart = [](const std::vector<std::string>& texts) {
    return texts.size() == 1 && texts[0].find(',') == std::string::npos;
  };
  if (entry.list && parts > 1 && values.size() == parts && std::ranges::all_of(values, isPart)) {
    std::vector<std::string> numbers;
    for (const auto& value : values) numbers.push_back(value[0]);
    values = {numbers};
  } else if (entry.list && !multiple) {
    throw OptionError(where + (parts > 1 ? " takes " + unit + ", a list of " + std::to_string(parts) + " numbers"
                                         : " takes one value, not a list"));
  }
  std::vector<std::string> texts;
  for (const auto& value : values) {
    if (value.size() != 1 && value.size() != parts) throw OptionError(where + " holds a list where one value belongs");
    texts.push_back(joined(value));
    if (texts.back().empty()) throw OptionError(where + " is an empty text; leave it out");
    if (texts.back().find('\0') != std::string::npos) throw OptionError(where + " holds a character 0");
  }
  return texts;
}

// `--config FILE` taken out of the arguments.
std::optional<std::string> takeConfig(std::vector<std::string>& arguments) {
  std::optional<std::string> file;
  for (std::size_t i = 0; i < endOfOptions(arguments);) {
    if (nameOf(arguments[i]) != "--config") {
      ++i;
      continue;
    }
    if (file) throw OptionError("--config is given twice; put all into one file");
    const std::size_t sign = arguments[i].find('=');
    if (sign == std::string::npos && i + 1 == arguments.size()) throw OptionError("--config needs a file");
    file = sign == std::string::npos ? arguments[i + 1] : arguments[i].substr(sign + 1);
    const auto at = arguments.begin() + static_cast<std::ptrdiff_t>(i);
    arguments.erase(at, at + (sign == std::string::npos ? 2 : 1));
  }
  return file;
}

}  // namespace

std::vector<std::string> expandConfig(const std::vector<std::string>& arguments, const std::string& usage,
                                      const std::set<std::string>& commands) {
  const Options options(usage);
  std::vector<std::string> expanded = arguments;
  const std::optional<std::string> file = takeConfig(expanded);
  if (!file) return arguments;

  const std::set<std::string> given = givenOnes(expanded, options);
  std::vector<std::string> from_file{"--config=" + *file}, inputs;
  std::set<std::string> seen;
  for (const ConfigEntry& entry : readConfigEntries(*file)) {
    if (!entry.section.empty() && entry.section != options.command()) {
      if (commands.contains(entry.section)) continue;
      throw OptionError(*file + ": there is no command '" + entry.section + "' to have a section of its own");
    }
    std::string name = entry.name;
    std::ranges::replace(name, '_', '-');
    const std::string where = *file + ": '" + entry.name + "'";
    const auto refuseTwice = [&](const std::string& known) {
      if (!seen.insert(known).second)
        throw OptionError(where + " is given twice, perhaps by another name or in another section");
    };
    if (options.isArgument(name)) {
      refuseTwice("");
      const Json any{{"multiple", true}};
      if (!given.contains("")) inputs = valuesFor(any, entry, where);
      continue;
    }
    const Json* option = options.find("--" + name);
    if (option == nullptr || name == "config") {
      throw OptionError(where + " is no option of 'coastmesh " + options.command() + "'; --help lists them");
    }
    const std::string known = (*option)["name"];
    refuseTwice(known);
    if (given.contains(known)) continue;
    if ((*option)["type"] == "flag") {
      if (entry.list) throw OptionError(where + " is a switch: say true or false");
      const std::string flag = flagFor(*option, name, entry.values[0][0], where);
      if (!flag.empty()) from_file.push_back(flag);
      continue;
    }
    for (const std::string& value : valuesFor(*option, entry, where)) from_file.push_back("--" + name + "=" + value);
  }
  const std::size_t end = endOfOptions(expanded);
  expanded.insert(expanded.begin() + static_cast<std::ptrdiff_t>(end), from_file.begin(), from_file.end());
  // What begins with a dash is the name of a file there, not an option.
  if (!inputs.empty() && end + from_file.size() == expanded.size()) expanded.emplace_back("--");
  expanded.insert(expanded.end(), inputs.begin(), inputs.end());
  return expanded;
}

}  // namespace coastmesh
