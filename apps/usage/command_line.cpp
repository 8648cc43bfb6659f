#include "apps/usage/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <map>
#include <utility>

namespace coastmesh {

namespace {

// CLI11 shows "--coarsen,--no-coarsen{false}"; which of the two is on is said in the description.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option_name(const CLI::Option* option, bool is_positional) const override {
    return CLI::detail::find_and_replace(CLI::Formatter::make_option_name(option, is_positional), "{false}", "");
  }
};

void bind(CLI::App& app, OptionTable& table, const OptionTable::Entry& entry) {
  const auto set = [&table, &entry](const std::string& text) {
    try {
      table.setText(entry.name, text);
    } catch (const OptionError& error) {
      throw CLI::ValidationError(entry.name, error.what());
    }
  };
  if (entry.kind == OptionKind::Flag) {
    const std::string help = entry.shown_help;
    app.add_flag(entry.names, help)->each([set](const std::string& text) {
      set(CLI::detail::to_flag_value(text) > 0 ? "true" : "false");
    });
    return;
  }
  CLI::Option* option = nullptr;
  if (entry.multiple) {
    const auto set_all = [set](const std::vector<std::string>& texts) { std::ranges::for_each(texts, set); };
    option = app.add_option_function<std::vector<std::string>>(entry.names, set_all, entry.shown_help);
    // One value a flag, so that `-o a.gpkg INPUT` does not take the input for an output.
    if (!entry.argument) option->allow_extra_args(false);
  } else {
    option = app.add_option_function<std::string>(entry.names, set, entry.shown_help);
  }
  option->type_name(entry.shown_unit)->required(entry.required);
  if (!entry.shown_default.empty()) option->default_str(entry.shown_default);
}

}  // namespace

OptionTable commandOptions(const std::string& name, const std::string& help) {
  OptionTable table(name, help);
  // What it says stands among the arguments when they are parsed: see apps/usage/config_file.hpp.
  table.file("--config",
             "take options from a TOML or JSON file, by their long names without dashes; those given here go before "
             "it");
  return table;
}

CommandLine::CommandLine(CLI::App& root, OptionTable table)
    : app_(root.add_subcommand(table.name(), table.help())), table_(std::make_unique<OptionTable>(std::move(table))) {
  app_->formatter(std::make_shared<HelpFormatter>());
  const OptionTable* options = table_.get();
  app_->add_flag_callback(
          "--json-usage", [options] { throw UsageText{options->jsonUsage()}; }, "print this usage as JSON")
      ->trigger_on_parse();
  for (const OptionTable::Entry* entry : table_->entries()) bind(*app_, *table_, *entry);
  if (const std::string examples = table_->examplesText(); !examples.empty()) app_->footer(examples);
}

CommandLine::~CommandLine() = default;
CommandLine::CommandLine(CommandLine&&) noexcept = default;

bool CommandLine::chosen() const { return app_->parsed(); }

std::vector<std::string> CommandLine::withPresentNames(std::vector<std::string> arguments,
                                                       std::vector<std::string>& warnings) const {
  std::map<std::string, std::string> present;
  for (const OptionTable::Entry* entry : table_->entries())
    present.insert(entry->former_names.begin(), entry->former_names.end());
  for (std::string& argument : arguments) {
    if (argument == "--") break;  // only arguments follow
    const std::size_t sign = std::min(argument.find('='), argument.size());
    const auto found = present.find(argument.substr(0, sign));
    if (found == present.end()) continue;
    warnings.push_back(found->first + " is called " + found->second +
                       " now; the next version will not take the former name");
    argument.replace(0, sign, found->second);
  }
  return arguments;
}

}  // namespace coastmesh
