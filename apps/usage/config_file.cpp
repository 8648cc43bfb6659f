#include "apps/usage/config_file.hpp"

#include <algorithm>
#include <cctype>

#include "apps/usage/config_entries.hpp"
#include "gis/coast/feature_names.hpp"
#include "gis/error.hpp"

namespace coastmesh {

namespace {

using Entry = OptionTable::Entry;

// What a name in a file refers to: an option or an argument.
struct Named {
  const Entry* entry = nullptr;
  std::string present;  // the present name without dashes if the file has a former one, otherwise empty
};

Named find(std::string name, const OptionTable& table) {
  std::ranges::replace(name, '_', '-');
  std::string large = name;
  std::ranges::transform(large, large.begin(), [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  for (const Entry* entry : table.entries()) {
    if (entry->argument && entry->name == large) return {entry, {}};
    if (entry->argument || entry->name == "--config") continue;
    for (const std::string& known : namesIn(entry->names))
      if (known == "--" + name) return {entry, {}};
    for (const auto& [former, present] : entry->former_names)
      if (former == "--" + name) return {entry, present.substr(2)};
  }
  return {};
}

// True if the switch is on: "no-coarsen = true" turns coarsening off.
bool isOn(const ConfigEntry& entry, const std::string& where) {
  const std::string value = entry.list ? std::string() : entry.values[0][0];  // a list may be empty
  if (value != "true" && value != "false") throw OptionError(where + " is a switch: say true or false");
  const bool negated = entry.name.starts_with("no-") || entry.name.starts_with("no_");
  return (value == "true") != negated;
}

// The values as texts. Lists are accepted for options that may be repeated, and for an option of several numbers as the
// list of these.
std::vector<std::string> textsFor(const Entry& option, const ConfigEntry& entry, const std::string& where) {
  const std::string& unit = option.shown_unit;
  const auto parts = static_cast<std::size_t>(1 + std::ranges::count(unit, ','));
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
  } else if (entry.list && !option.multiple) {
    throw OptionError(where + (parts > 1 ? " takes " + unit + ", a list of " + std::to_string(parts) + " numbers"
                                         : " takes one value, not a list"));
  }
  std::vector<std::string> texts;
  for (const auto& value : values) {
    if (value.size() != 1 && value.size() != parts) throw OptionError(where + " holds a list where one value belongs");
    texts.push_back(joined(value));
    if (texts.back().find('\0') != std::string::npos) throw OptionError(where + " holds a character 0");
  }
  return texts;
}

void give(const Entry& option, const ConfigEntry& entry, const std::string& where, OptionTable& table) {
  if (option.kind == OptionKind::Flag) {
    const bool on = isOn(entry, where);
    // A switch without an opposite is off already.
    const auto turnsIt = [on](const std::string& name) { return name.starts_with("--no-") != on; };
    if (std::ranges::any_of(namesIn(option.names), turnsIt)) table.set(option.name, on, entry.values[0][0]);
    return;
  }
  for (const std::string& text : textsFor(option, entry, where)) {
    try {
      table.setText(option.name, text);
    } catch (const OptionError& error) {
      throw OptionError(where + ": " + error.what());
    }
  }
}

}  // namespace

void takeConfig(const std::string& file, OptionTable& table, const std::set<std::string>& commands,
                std::vector<std::string>& warnings) {
  std::set<const Entry*> given, seen;
  for (const Entry* entry : table.entries())
    if (!table.given(entry->name).empty()) given.insert(entry);
  const ConfigEntries read = readConfigEntries(file);
  for (const std::string& section : read.sections) {
    if (section == table.name() || commands.contains(section)) continue;
    throw OptionError(sourceInWords(file) + ": " +
                      (find(section, table).entry != nullptr
                           ? "'" + section + "' is an option and takes no section"
                           : "there is no command '" + section + "' to have a section of its own"));
  }
  for (const ConfigEntry& entry : read.entries) {
    if (!entry.section.empty() && entry.section != table.name()) continue;
    const std::string where = sourceInWords(file) + ": '" + entry.name + "'";
    const auto [option, present] = find(entry.name, table);
    if (option == nullptr)
      throw OptionError(where + " is not an option of 'coastmesh " + table.name() + "'; --help lists them");
    if (!seen.insert(option).second)
      throw OptionError(where + " is given twice, perhaps by another name or in another section");
    if (!present.empty())
      warnings.push_back(where + " is called '" + present + "' now; the next version will not accept the former name");
    if (!given.contains(option)) give(*option, entry, where, table);
  }
}

}  // namespace coastmesh
