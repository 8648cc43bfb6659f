#include "apps/usage/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <utility>
#include <variant>

#include "apps/usage/config_file.hpp"

namespace coastmesh {

namespace {

constexpr const char* kConfig = "--config";

class HelpFormatter : public CLI::Formatter {
 public:
  explicit HelpFormatter(std::set<const CLI::Option*> required) : required_(std::move(required)) {}

  // CLI11 shows "--coarsen,--no-coarsen{false}"; the description says which of the two is the default.
  std::string make_option_name(const CLI::Option* option, bool is_positional) const override {
    return CLI::detail::find_and_replace(CLI::Formatter::make_option_name(option, is_positional), "{false}", "");
  }
  // CLI11 puts an empty line both after and before a group.
  std::string make_help(const CLI::App* app, std::string name, CLI::AppFormatMode mode) const override {
    return CLI::detail::find_and_replace(CLI::Formatter::make_help(app, std::move(name), mode), "\n\n\n", "\n\n");
  }
  // Required options may also be given in a file, so that to CLI11 nothing is required. It also shows "FILE ..." for
  // options that take one value each time.
  std::string make_option_opts(const CLI::Option* option) const override {
    std::string options = CLI::Formatter::make_option_opts(option);
    if (!option->get_positional()) options = CLI::detail::find_and_replace(options, " ...", " (repeat)");
    return options + (required_.contains(option) ? " " + get_label("REQUIRED") : "");
  }
  std::string make_option_usage(const CLI::Option* option) const override {
    const std::string usage = CLI::Formatter::make_option_usage(option);
    return required_.contains(option) ? usage.substr(1, usage.size() - 2) : usage;  // without the brackets
  }

 private:
  std::set<const CLI::Option*> required_;
};

CLI::Option* bind(CLI::App& app, OptionTable& table, const OptionTable::Entry& entry) {
  const auto set = [&table, &entry](const std::string& text) {
    try {
      table.setText(entry.name, text);
    } catch (const OptionError& error) {
      throw CLI::ValidationError(entry.name, error.what());
    }
  };
  // CLI11 passes "true" or "false": it negates the values of opposites, and `toParse` passes no other values.
  if (entry.kind == OptionKind::Flag) return app.add_flag(entry.names, entry.shown_help)->each(set);
  CLI::Option* option = nullptr;
  if (entry.multiple) {
    const auto set_all = [set](const std::vector<std::string>& texts) { std::ranges::for_each(texts, set); };
    option = app.add_option_function<std::vector<std::string>>(entry.names, set_all, entry.shown_help);
    // One value per flag, so that `-o a.gpkg INPUT` does not take the input for an output.
    if (!entry.argument) option->allow_extra_args(false);
  } else {
    option = app.add_option_function<std::string>(entry.names, set, entry.shown_help);
  }
  option->type_name(entry.shown_unit);
  if (!entry.shown_default.empty()) option->default_str(entry.shown_default);
  return option;
}

// True if `value` turns a switch on; throws OptionError if it is no truth value. `shown`: the whole argument.
bool isOn(const std::string& shown, const std::string& value) {
  for (const char* const yes : {"true", "on", "yes", "1"})
    if (value == yes) return true;
  for (const char* const no : {"false", "off", "no", "0"})
    if (value == no) return false;
  throw OptionError(shown + " is a switch: say true or false");
}

}  // namespace

OptionTable commandOptions(const std::string& name, const std::string& help) {
  OptionTable table(name, help);
  table.section(Section::Run);
  table.file(
      {kConfig, "Options from a file"},
      "read options from a TOML or JSON file, by their long names without dashes; the command line overrides it");
  return table;
}

CommandLine::CommandLine(CLI::App& root, OptionTable table)
    : app_(root.add_subcommand(table.name(), table.help())), table_(std::make_unique<OptionTable>(std::move(table))) {
  const OptionTable* options = table_.get();
  std::set<const CLI::Option*> required;
  for (const OptionTable::Entry* entry : table_->entries()) {
    CLI::Option* const option = bind(*app_, *table_, *entry);
    if (!entry->argument) option->group(sectionTitle(entry->section));
    if (entry->required) required.insert(option);
  }
  // CLI11 shows groups in the order of their first options: its own come last.
  const std::string last = sectionTitle(Section::Run);
  app_->set_help_flag();
  app_->set_help_flag("-h,--help", "print this help")->group(last);
  app_->add_flag_callback(
          "--json-usage", [options] { throw UsageText{options->jsonUsage()}; }, "print this usage as JSON")
      ->trigger_on_parse()
      ->group(last);
  app_->formatter(std::make_shared<HelpFormatter>(std::move(required)));
  if (const std::string examples = table_->examplesText(); !examples.empty()) app_->footer(examples);
}

CommandLine::~CommandLine() = default;
CommandLine::CommandLine(CommandLine&&) noexcept = default;

bool CommandLine::chosen() const { return app_->parsed(); }

void CommandLine::complete(const std::set<std::string>& commands, std::vector<std::string>& warnings) {
  const std::vector<OptionValue>& files = table_->given(kConfig);
  if (!files.empty()) takeConfig(std::get<std::string>(files.front()), *table_, commands, warnings);
  const std::vector<std::string> missing = table_->missing();
  if (!missing.empty()) throw OptionError(missing.front() + " is required; coastmesh COMMAND --help lists the options");
}

std::vector<std::string> CommandLine::toParse(const std::vector<std::string>& arguments,
                                              std::vector<std::string>& warnings) const {
  std::map<std::string, std::string> present;
  std::map<std::string, const OptionTable::Entry*> named;
  std::string argument_name;  // the argument that may be repeated; empty if there is none
  for (const OptionTable::Entry* entry : table_->entries()) {
    if (entry->argument && entry->multiple) argument_name = entry->name;
    if (entry->argument) continue;
    present.insert(entry->former_names.begin(), entry->former_names.end());
    for (const std::string& name : namesIn(entry->names)) named.emplace(name, entry);
  }
  std::vector<std::string> words;
  bool any_argument = false;
  // "--weirs a.shp b.shp": the second is an argument, not a value.
  const auto warnOfArgumentAfter = [&](const std::string& name, const OptionTable::Entry& entry, auto next) {
    if (argument_name.empty() || !entry.multiple || !any_argument || next == arguments.end() || next->starts_with("-"))
      return;
    warnings.push_back(*next + " is one more " + argument_name + ": " + name +
                       " takes one value; give the option again for each");
  };
  for (auto argument = arguments.begin(); argument != arguments.end(); ++argument) {
    if (*argument == "--") {  // only arguments follow
      words.insert(words.end(), argument, arguments.end());
      break;
    }
    const std::size_t sign =
        argument->starts_with("--") ? std::min(argument->find('='), argument->size()) : argument->size();
    const bool with_value = sign < argument->size();
    std::string name = argument->substr(0, sign);
    if (const auto former = present.find(name); former != present.end()) {
      warnings.push_back(name + " is called " + former->second +
                         " now; the next version will not accept the former name");
      name = former->second;
    }
    const auto option = named.find(name);
    if (option == named.end()) {
      words.push_back(*argument);
      any_argument = any_argument || !argument->starts_with("-");
    } else if (option->second->kind == OptionKind::Flag) {
      words.push_back(with_value ? name + (isOn(*argument, argument->substr(sign + 1)) ? "=true" : "=false") : name);
    } else {
      // Two words, since CLI11 would take the next word for the value of "--name=".
      words.push_back(name);
      if (with_value) {
        words.push_back(argument->substr(sign + 1));
      } else if (argument + 1 != arguments.end()) {
        words.push_back(*++argument);
      }
      warnOfArgumentAfter(name, *option->second, argument + 1);
    }
  }
  return words;
}

}  // namespace coastmesh
