#include "apps/usage/command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <utility>

#include "core/computable.hpp"

namespace coastmesh {

namespace {

using Json = nlohmann::ordered_json;

std::string shortNumber(double value) {
  std::string text = Json(value).dump();
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text;
}

std::string rangeText(const NumberRange& range) {
  const bool low = std::isfinite(range.low);
  const bool high = std::isfinite(range.high);
  if (low && high)
    return range.low_open ? "above " + shortNumber(range.low) + ", up to " + shortNumber(range.high)
                          : shortNumber(range.low) + " to " + shortNumber(range.high);
  if (low) return range.low_open ? "above " + shortNumber(range.low) : shortNumber(range.low) + " or more";
  if (high) return shortNumber(range.high) + " or less";
  return {};
}

// "--coarsen,!--no-coarsen" as the names that a user may type.
std::vector<std::string> splitNames(const std::string& names) {
  std::vector<std::string> parts;
  for (std::string name : CLI::detail::split(names, ',')) {
    if (name.starts_with('!')) name.erase(0, 1);
    parts.push_back(name);
  }
  return parts;
}

CLI::Validator rangeCheck(const NumberRange& range) {
  return CLI::Validator(
      [range](const std::string& text) -> std::string {
        double value = 0.0;
        const bool number = CLI::detail::lexical_cast(text, value) && std::isfinite(value);
        const bool within = number && value <= range.high && (range.low_open ? value > range.low : value >= range.low);
        const std::string wanted = rangeText(range);
        if (!within) return "'" + text + "' is not a number" + (wanted.empty() ? "" : " in the range " + wanted);
        if (isComputable(value)) return {};
        return "'" + text + "' is " + (std::abs(value) < 1 ? "nearer to 0 than 1e-70" : "beyond -1e70 to 1e70") +
               ", where coordinates end" + (wanted.empty() ? "" : "; the range is " + wanted);
      },
      "");
}

constexpr const char* kOutputFile = "FILE:output";

bool isFile(const std::string& unit) { return unit == "FILE" || unit.starts_with("FILE:"); }
bool isInput(const std::string& unit) { return isFile(unit) && unit != kOutputFile; }
std::string shownUnit(const std::string& unit) { return isFile(unit) ? "FILE" : unit; }

// CLI11 shows "--coarsen,--no-coarsen{false}"; which of the two is on is said in the description.
class HelpFormatter : public CLI::Formatter {
 public:
  std::string make_option_name(const CLI::Option* option, bool is_positional) const override {
    return CLI::detail::find_and_replace(CLI::Formatter::make_option_name(option, is_positional), "{false}", "");
  }
};

}  // namespace

struct CommandLine::Impl {
  CLI::App* app = nullptr;
  Json arguments = Json::array();
  Json options = Json::array();

  Json examples = Json::array();
  std::string config;

  std::vector<std::function<void(std::vector<NamedFile>&)>> inputs;
  std::vector<std::function<void(std::vector<NamedOutput>&)>> outputs;

  static bool isRead(const std::string& path) { return !path.empty() && path != "-"; }

  void readsFrom(const std::string& name, const std::string& value) {
    inputs.push_back([name, &value](auto& all) {
      if (isRead(value)) all.push_back({name, value});
    });
  }

  void readsFrom(const std::string& name, const std::vector<std::string>& values) {
    inputs.push_back([name, &values](auto& all) {
      for (const std::string& value : values)
        if (isRead(value)) all.push_back({name, value});
    });
  }

  using Visit = std::function<void(const std::string& path)>;
  void writesTo(const std::string& name, OutputKind kind, std::function<void(const Visit&)> each) {
    outputs.push_back([name, kind = std::move(kind), each = std::move(each)](std::vector<NamedOutput>& all) {
      each([&](const std::string& path) {
        if (path == "-" && kind.standard_output) return;
        if (path == "-")
          throw OptionError(name +
                            " -: this cannot be written to standard output; name a file, a file called '-' as ./-");
        all.push_back({name, path, kind.files ? kind.files(path) : OutputFiles{{path}, {}, {}}});
      });
    });
  }

  // When an option counts.
  struct Condition {
    std::string option;
    std::function<bool()> holds;
    std::string else_text;
  };
  std::vector<Condition> conditions;

  bool given(const std::string& name) const { return app->get_option(name)->count() > 0; }

  // Given, and not as what it is without being given: "--time-step 0" asks for none.
  bool active(const std::string& name) const {
    if (!given(name)) return false;
    const CLI::Option* option = app->get_option(name);
    const std::string value = option->results().front(), initial = option->get_default_str();
    double number = 0.0, initial_number = 0.0;
    if (CLI::detail::lexical_cast(value, number) && CLI::detail::lexical_cast(initial, initial_number))
      return number != initial_number;
    return value != initial;
  }

  // Of "--time-step" that it is active, of "--coast follow" that it is given as that.
  bool fulfilled(const std::string& need) const {
    const std::size_t space = need.find(' ');
    const std::string name = need.substr(0, space);
    if (app->get_option_no_throw(name) == nullptr) throw std::logic_error("there is no option " + name + " to need");
    if (space == std::string::npos) return active(name);
    return given(name) && app->get_option(name)->results().front() == need.substr(space + 1);
  }

  Json usage() const {
    Json usage{
        {"command", app->get_name()}, {"help", app->get_description()}, {"arguments", arguments}, {"options", options}};
    if (!examples.empty()) usage["examples"] = examples;
    return usage;
  }

  std::string examplesText() const {
    std::string text = "Examples:";
    for (const Json& example : examples) {
      text += "\n  " + example["help"].get<std::string>() + "\n    " + example["command"].get<std::string>();
    }
    return text + "\n";
  }

  Json& entryOf(const std::string& name) {
    return *std::ranges::find_if(options, [&](const Json& entry) { return entry["name"] == name; });
  }

  Json& record(const std::string& names, const std::string& type, const std::string& unit, const std::string& help) {
    Json entry{{"name", splitNames(names).back()}, {"names", splitNames(names)}, {"type", type}, {"help", help}};
    if (!unit.empty()) entry["unit"] = shownUnit(unit);
    if (isFile(unit)) entry["role"] = unit == "FILE" ? "input" : unit.substr(unit.find(':') + 1);
    options.push_back(std::move(entry));
    return options.back();
  }
};

CommandLine::CommandLine(CLI::App& root, const std::string& name, const std::string& help)
    : impl_(std::make_unique<Impl>()) {
  impl_->app = root.add_subcommand(name, help);
  impl_->app->formatter(std::make_shared<HelpFormatter>());
  const Impl* impl = impl_.get();
  impl_->app
      ->add_flag_callback(
          "--json-usage", [impl] { throw UsageText{impl->usage().dump(2) + "\n"}; }, "print this usage as JSON")
      ->trigger_on_parse();
  // What it says stands among the arguments when they are parsed: see apps/usage/config_file.hpp.
  text("--config", impl_->config, "FILE",
       "take options from a TOML or JSON file, by their long names without dashes; those given here go before it");
}

const CommandLine::Option& CommandLine::Option::needs(std::function<bool()> holds, const std::string& else_text) const {
  line_->impl_->conditions.push_back({name_, std::move(holds), else_text});
  return *this;
}

const CommandLine::Option& CommandLine::Option::needs(std::vector<std::string> others) const {
  const std::string text =
      "without " + std::string(others.size() > 1 ? "one of " : "") + CLI::detail::join(others, ", ");
  Json& entry = line_->impl_->entryOf(name_);
  entry["needs"].push_back(others);
  const Impl* impl = line_->impl_.get();
  return needs(
      [impl, others] {
        // All of them are asked, so that a name that is none shows.
        return std::ranges::count_if(others, [impl](const std::string& other) { return impl->fulfilled(other); }) > 0;
      },
      text);
}

const CommandLine::Option& CommandLine::Option::ignoredWith(std::vector<std::string> others) const {
  const Impl* impl = line_->impl_.get();
  for (const std::string& other : others) {
    needs([impl, other] { return !impl->fulfilled(other); }, "with " + other);
  }
  return *this;
}

const CommandLine::Option& CommandLine::Option::formerly(const std::vector<std::string>& names) const {
  Json& entry = line_->impl_->entryOf(name_);
  if (names.size() != entry["names"].size())
    throw std::logic_error(name_ + " does not have as many former names as names");
  for (std::size_t i = 0; i < names.size(); ++i) entry["former_names"][names[i]] = entry["names"][i];
  return *this;
}

CommandLine::~CommandLine() = default;
CommandLine::CommandLine(CommandLine&&) noexcept = default;

void CommandLine::argument(const std::string& name, std::string& value, const std::string& help) {
  impl_->app->add_option(name, value, help)->type_name("FILE")->required();
  impl_->arguments.push_back({{"name", name}, {"type", "file"}, {"multiple", false}, {"help", help}});
  impl_->readsFrom(name, value);
}

void CommandLine::arguments(const std::string& name, std::vector<std::string>& values, const std::string& help) {
  impl_->app->add_option(name, values, help)->type_name("FILE")->required();
  impl_->arguments.push_back({{"name", name}, {"type", "file"}, {"multiple", true}, {"help", help}});
  impl_->readsFrom(name, values);
}

CommandLine::Option CommandLine::number(const std::string& names, double& value, const std::string& unit,
                                        const NumberRange& range, const std::string& help, bool* given) {
  const bool has_default = std::isfinite(value);
  const std::string wanted = rangeText(range);
  const auto store = [&value, given](double number) {
    value = number;
    if (given != nullptr) *given = true;
  };
  impl_->app->add_option_function<double>(names, store, help + (wanted.empty() ? "" : " (" + wanted + ")"))
      ->type_name(unit)
      ->check(rangeCheck(range))
      ->default_str(has_default ? shortNumber(value) : "none");
  Json& entry = impl_->record(names, "number", unit, help);
  entry["default"] = has_default ? Json(value) : Json(nullptr);
  if (std::isfinite(range.low)) entry[range.low_open ? "exclusive_minimum" : "minimum"] = range.low;
  if (std::isfinite(range.high)) entry["maximum"] = range.high;
  return {*this, entry["name"]};
}

CommandLine::Option CommandLine::integer(const std::string& names, std::uint64_t& value, const std::string& unit,
                                         std::uint64_t low, std::uint64_t high, const std::string& help) {
  constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();
  const bool has_default = value != kNoLimit;
  const std::string wanted = std::to_string(low) + (high == kNoLimit ? " or more" : " to " + std::to_string(high));
  const auto check = [low, high, wanted](const std::string& text) -> std::string {
    std::uint64_t number = 0;
    if (!text.starts_with('-') && CLI::detail::lexical_cast(text, number) && number >= low && number <= high) return {};
    return "'" + text + "' is not a whole number in the range " + wanted;
  };
  impl_->app->add_option(names, value, help + " (" + wanted + ")")
      ->type_name(unit)
      ->check(CLI::Validator(check, ""))
      ->default_str(has_default ? std::to_string(value) : "none");
  Json& entry = impl_->record(names, "integer", unit, help);
  entry["default"] = has_default ? Json(value) : Json(nullptr);
  entry["minimum"] = low;
  if (high != kNoLimit) entry["maximum"] = high;
  return {*this, entry["name"]};
}

CommandLine::Option CommandLine::text(const std::string& names, std::string& value, const std::string& unit,
                                      const std::string& help) {
  impl_->app->add_option(names, value, help)->type_name(shownUnit(unit))->default_str(value);
  Json& entry = impl_->record(names, isFile(unit) ? "file" : "text", unit, help);
  entry["default"] = value.empty() ? Json(nullptr) : Json(value);
  if (isInput(unit)) impl_->readsFrom(entry["name"], value);
  return {*this, entry["name"]};
}

CommandLine::Option CommandLine::text(const std::string& names, const std::string& unit,
                                      const std::function<void(const std::string&)>& store, const std::string& help) {
  impl_->app->add_option_function<std::string>(names, store, help)->type_name(shownUnit(unit));
  Json& entry = impl_->record(names, "text", unit, help);
  entry["default"] = nullptr;
  return {*this, entry["name"]};
}

CommandLine::Option CommandLine::requiredText(const std::string& names, std::string& value, const std::string& unit,
                                              const std::string& help) {
  impl_->app->add_option(names, value, help)->type_name(shownUnit(unit))->required();
  Json& entry = impl_->record(names, isFile(unit) ? "file" : "text", unit, help);
  entry["required"] = true;
  if (isInput(unit)) impl_->readsFrom(entry["name"], value);
  return {*this, entry["name"]};
}

CommandLine::Option CommandLine::texts(const std::string& names, std::vector<std::string>& values,
                                       const std::string& unit, bool required, const std::string& help) {
  // One value a flag, so that `-o a.gpkg INPUT` does not take the input for an output.
  impl_->app->add_option(names, values, help)->type_name(shownUnit(unit))->allow_extra_args(false)->required(required);
  Json& entry = impl_->record(names, isFile(unit) ? "file" : "text", unit, help);
  entry["multiple"] = true;
  entry["required"] = required;
  if (isInput(unit)) impl_->readsFrom(entry["name"], values);
  return {*this, entry["name"]};
}

CommandLine::Option CommandLine::choice(const std::string& names, std::string& value,
                                        const std::vector<std::string>& choices, const std::string& help) {
  return choice(
      names, value, choices, [&value](const std::string& chosen) { value = chosen; }, help);
}

CommandLine::Option CommandLine::choice(const std::string& names, const std::string& initial,
                                        const std::vector<std::string>& choices,
                                        const std::function<void(const std::string&)>& store, const std::string& help) {
  const auto check = [choices](const std::string& text) -> std::string {
    for (const std::string& choice : choices) {
      if (text == choice) return {};
    }
    return "'" + text + "' is none of " + CLI::detail::join(choices, ", ");
  };
  impl_->app->add_option_function<std::string>(names, store, help)
      ->type_name(CLI::detail::join(choices, "|"))
      ->check(CLI::Validator(check, ""))
      ->default_str(initial);
  Json& entry = impl_->record(names, "choice", {}, help);
  entry["default"] = initial;
  entry["choices"] = choices;
  return {*this, entry["name"]};
}

CommandLine::Option CommandLine::flag(const std::string& names, bool& value, const std::string& help, bool* given) {
  const std::string shown = names.find('!') == std::string::npos ? help : help + (value ? " (on)" : " (off)");
  CLI::Option* option = impl_->app->add_flag(names, value, shown);
  if (given != nullptr) option->each([given](const std::string&) { *given = true; });
  Json& entry = impl_->record(names, "flag", {}, help);
  entry["name"] = names.find('!') == std::string::npos ? splitNames(names).back() : splitNames(names).front();
  entry["default"] = value;
  return {*this, entry["name"]};
}

void CommandLine::needing(const std::vector<std::string>& others, const std::function<void()>& declare) {
  const std::size_t first = impl_->options.size();
  declare();
  for (std::size_t i = first; i < impl_->options.size(); ++i) Option(*this, impl_->options[i]["name"]).needs(others);
}

CommandLine::Option CommandLine::output(const std::string& names, std::string& value, OutputKind kind,
                                        const std::string& help) {
  const Option option =
      kind.required ? requiredText(names, value, kOutputFile, help) : text(names, value, kOutputFile, help);
  impl_->writesTo(option.name_, std::move(kind), [&value](const auto& visit) {
    if (!value.empty()) visit(value);
  });
  return option;
}

CommandLine::Option CommandLine::outputs(const std::string& names, std::vector<std::string>& values, OutputKind kind,
                                         const std::string& help) {
  const Option option = texts(names, values, kOutputFile, kind.required, help);
  impl_->writesTo(option.name_, std::move(kind),
                  [&values](const auto& visit) { std::ranges::for_each(values, visit); });
  return option;
}

void CommandLine::example(const std::string& command, const std::string& help) {
  impl_->examples.push_back({{"command", command}, {"help", help}});
  impl_->app->footer(impl_->examplesText());
}

const std::string& CommandLine::name() const { return impl_->app->get_name(); }

bool CommandLine::chosen() const { return impl_->app->parsed(); }

std::vector<std::string> CommandLine::withPresentNames(std::vector<std::string> arguments,
                                                       std::vector<std::string>& warnings) const {
  std::map<std::string, std::string> present;
  for (const Json& option : impl_->options)
    if (option.contains("former_names"))
      for (const auto& [former, name] : option["former_names"].items()) present.emplace(former, name);
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

std::vector<CommandLine::NamedFile> CommandLine::inputs() const {
  std::vector<NamedFile> all;
  for (const auto& collect : impl_->inputs) collect(all);
  return all;
}

std::vector<CommandLine::NamedOutput> CommandLine::outputs() const {
  std::vector<NamedOutput> all;
  for (const auto& collect : impl_->outputs) collect(all);
  return all;
}

std::vector<std::string> CommandLine::withoutEffect() const {
  std::vector<std::string> sentences;
  for (const auto& [option, holds, else_text] : impl_->conditions) {
    const bool effective = holds();  // asked for those not given too, so that a condition that cannot be asked shows
    if (!effective && impl_->given(option)) sentences.push_back(option + " has no effect " + else_text);
  }
  return sentences;
}

std::string CommandLine::jsonUsage() const { return impl_->usage().dump(2) + "\n"; }

}  // namespace coastmesh
