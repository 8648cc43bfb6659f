#include "apps/usage/option_table.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>

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

// What is wrong with a number, as the end of a sentence about it; empty if nothing.
std::string wrongWith(double value, const NumberRange& range) {
  const bool number = std::isfinite(value);
  const bool within = number && value <= range.high && (range.low_open ? value > range.low : value >= range.low);
  const std::string wanted = rangeText(range);
  if (!within) return "is not a number" + (wanted.empty() ? "" : " in the range " + wanted);
  if (isComputable(value)) return {};
  return std::string("is ") + (std::abs(value) < 1 ? "nearer to 0 than 1e-70" : "beyond -1e70 to 1e70") +
         ", where coordinates end" + (wanted.empty() ? "" : "; the range is " + wanted);
}

std::string joined(const std::vector<std::string>& texts, const std::string& between) {
  std::string all;
  for (const std::string& text : texts) all += (all.empty() ? "" : between) + text;
  return all;
}

constexpr const char* kOutputFile = "FILE:output";

bool isFile(const std::string& unit) { return unit == "FILE" || unit.starts_with("FILE:"); }
bool isInput(const std::string& unit) { return isFile(unit) && unit != kOutputFile; }
std::string shownUnit(const std::string& unit) { return isFile(unit) ? "FILE" : unit; }

const char* typeName(OptionKind kind) {
  switch (kind) {
    case OptionKind::Flag:
      return "flag";
    case OptionKind::Number:
      return "number";
    case OptionKind::Integer:
      return "integer";
    case OptionKind::Choice:
      return "choice";
    case OptionKind::File:
      return "file";
    case OptionKind::Numbers:
    case OptionKind::Text:
      break;
  }
  return "text";
}

}  // namespace

const char* sectionTitle(Section section) {
  constexpr const char* kTitles[] = {
      "Input",   "Domain", "Triangles", "Sizes", "Coast", "Depths", "Boundaries and models",
      "Picture", "Output", "The run"};
  return kTitles[static_cast<std::size_t>(section)];
}

std::string saidOf(const std::string& label, const std::string& help, const std::string& mark) {
  if (label.empty()) return help;
  const auto sameLetter = [](char a, char b) { return std::tolower(a) == std::tolower(b); };
  const bool begins = std::ranges::equal(label, help.substr(0, label.size()), sameLetter);
  return mark + label + mark + (begins ? help.substr(label.size()) : ": " + help);
}

struct OptionTable::Impl {
  // Stores a value, or returns what is wrong with it as the end of a sentence about it.
  using Store = std::function<std::string(const OptionValue&)>;

  struct Declared {
    Entry entry;
    Json json;
    Store store;
    std::size_t numbers = 0;  // of OptionKind::Numbers
    OptionValue initial;
    std::vector<OptionValue> given;
    std::function<bool()> spared;      // true if it need not be given although it is required; may be empty
    bool reads = false;                // names files to read
    FilesIn files_in;                  // if it does so within a text; may be empty
    std::optional<OutputKind> writes;  // names files to write
  };

  std::string name, help;
  Section section = Section::Run;
  // Pointers, since callers keep the addresses of entries.
  std::vector<std::unique_ptr<Declared>> all;
  Json examples = Json::array();

  struct Condition {
    std::string option;
    std::function<bool()> holds;
    std::string else_text;
  };
  std::vector<Condition> conditions;

  Declared* find(const std::string& wanted) const {
    const auto found = std::ranges::find_if(all, [&](const auto& one) { return one->entry.name == wanted; });
    return found == all.end() ? nullptr : found->get();
  }
  Declared& declared(const std::string& wanted) const {
    Declared* found = find(wanted);
    if (found == nullptr) throw std::logic_error("no option " + wanted + " is declared");
    return *found;
  }

  Declared& add(const OptionNames& names, OptionKind kind, const std::string& unit, const std::string& help_text,
                const std::string& range = {}) {
    const std::vector<std::string> split = namesIn(names.typed);
    Declared& added = *all.emplace_back(std::make_unique<Declared>());
    added.entry.names = names.typed;
    added.entry.label = names.label;
    added.entry.section = section;
    const bool with_opposite = names.typed.find('!') != std::string::npos;
    added.entry.name = with_opposite ? split.front() : split.back();
    added.entry.kind = kind;
    added.entry.shown_unit = shownUnit(unit);
    added.entry.shown_help = saidOf(names.label, help_text) + (range.empty() ? "" : " (" + range + ")");
    added.json = {{"name", added.entry.name},         {"names", split},         {"label", names.label},
                  {"section", sectionTitle(section)}, {"type", typeName(kind)}, {"help", help_text}};
    if (!unit.empty()) added.json["unit"] = shownUnit(unit);
    if (isFile(unit)) added.json["role"] = unit == "FILE" ? "input" : unit.substr(unit.find(':') + 1);
    added.reads = isInput(unit);
    return added;
  }

  Declared& addText(const OptionNames& names, std::string& value, const std::string& unit,
                    const std::string& help_text) {
    Declared& added = add(names, isFile(unit) ? OptionKind::File : OptionKind::Text, unit, help_text);
    added.initial = value;
    added.store = [&value](const OptionValue& given) {
      value = std::get<std::string>(given);
      return std::string{};
    };
    return added;
  }

  Declared& addArgument(const std::string& argument, const std::string& help_text, OptionKind kind = OptionKind::File,
                        const std::string& range = {}) {
    Declared& added = add(argument.c_str(), kind, kind == OptionKind::File ? "FILE" : "", help_text, range);
    added.entry.argument = true;
    added.entry.required = true;
    added.initial = std::string{};
    return added;
  }

  bool given(const std::string& wanted) const { return !declared(wanted).given.empty(); }

  // True if given with a value other than its default: "--time-step 0" is not active.
  bool active(const std::string& wanted) const {
    const Declared& option = declared(wanted);
    return !option.given.empty() && option.given.front() != option.initial;
  }

  // "--time-step" is fulfilled if it is active, "--coast follow" if that value is given.
  bool fulfilled(const std::string& need) const {
    const std::size_t space = need.find(' ');
    if (space == std::string::npos) return active(need);
    const Declared& option = declared(need.substr(0, space));
    return !option.given.empty() && option.given.front() == OptionValue(need.substr(space + 1));
  }

  // Arguments first, then options by section.
  std::vector<const Declared*> shown() const {
    std::vector<const Declared*> order;
    for (const auto& one : all) order.push_back(one.get());
    std::ranges::stable_sort(order, {}, [](const Declared* one) {
      return std::pair(!one->entry.argument, one->entry.argument ? Section::Input : one->entry.section);
    });
    return order;
  }

  Json usage() const {
    Json arguments = Json::array(), options = Json::array();
    for (const Declared* one : shown()) {
      if (!one->entry.argument)
        options.push_back(one->json);
      else
        arguments.push_back({{"name", one->entry.name},
                             {"type", typeName(one->entry.kind)},
                             {"multiple", one->entry.multiple},
                             {"help", one->json["help"]}});
    }
    Json usage{{"command", name}, {"help", help}, {"arguments", arguments}, {"options", options}};
    if (!examples.empty()) usage["examples"] = examples;
    return usage;
  }
};

OptionTable::OptionTable(const std::string& name, const std::string& help) : impl_(std::make_unique<Impl>()) {
  impl_->name = name;
  impl_->help = help;
}
OptionTable::~OptionTable() = default;
OptionTable::OptionTable(OptionTable&&) noexcept = default;

const OptionTable::Option& OptionTable::Option::needs(std::function<bool()> holds, const std::string& else_text) const {
  table_->impl_->conditions.push_back({name_, std::move(holds), else_text});
  return *this;
}

const OptionTable::Option& OptionTable::Option::needs(std::vector<std::string> others,
                                                      const std::function<bool()>& in_place) const {
  const std::string text = "without " + std::string(others.size() > 1 ? "one of " : "") + joined(others, ", ");
  table_->impl_->declared(name_).json["needs"].push_back(others);
  const Impl* impl = table_->impl_.get();
  return needs(
      [impl, others, in_place] {
        // Evaluates all of them, so that an undeclared name throws.
        const auto isFulfilled = [impl](const std::string& other) { return impl->fulfilled(other); };
        return std::ranges::count_if(others, isFulfilled) > 0 || (in_place && in_place());
      },
      text);
}

const OptionTable::Option& OptionTable::Option::ignoredWith(std::vector<std::string> others) const {
  const Impl* impl = table_->impl_.get();
  for (const std::string& other : others) {
    needs([impl, other] { return !impl->fulfilled(other); }, "with " + other);
  }
  return *this;
}

const OptionTable::Option& OptionTable::Option::formerly(const std::vector<std::string>& names) const {
  Impl::Declared& option = table_->impl_->declared(name_);
  const std::vector<std::string> present = namesIn(option.entry.names);
  if (names.size() != present.size()) throw std::logic_error(name_ + " does not have as many former names as names");
  for (std::size_t i = 0; i < names.size(); ++i) {
    option.json["former_names"][names[i]] = present[i];
    option.entry.former_names.emplace_back(names[i], present[i]);
  }
  return *this;
}

void OptionTable::section(Section section) { impl_->section = section; }

void OptionTable::argument(const std::string& name, std::string& value, const std::string& help) {
  impl_->addArgument(name, help).store = [&value](const OptionValue& given) {
    value = std::get<std::string>(given);
    return std::string{};
  };
}

void OptionTable::arguments(const std::string& name, std::vector<std::string>& values, const std::string& help,
                            const std::function<bool()>& spared) {
  Impl::Declared& added = impl_->addArgument(name, help);
  added.spared = spared;
  added.entry.multiple = true;
  added.store = [&values](const OptionValue& given) {
    values.push_back(std::get<std::string>(given));
    return std::string{};
  };
}

OptionTable::Option OptionTable::number(const OptionNames& names, double& value, const std::string& unit,
                                        const NumberRange& range, const std::string& help, bool* given) {
  const bool has_default = std::isfinite(value);
  Impl::Declared& added = impl_->add(names, OptionKind::Number, unit, help, rangeText(range));
  added.initial = value;
  added.store = [&value, given, range](const OptionValue& asked) {
    const double number = std::get<double>(asked);
    std::string wrong = wrongWith(number, range);
    if (!wrong.empty()) return wrong;
    value = number;
    if (given != nullptr) *given = true;
    return wrong;
  };
  added.entry.shown_default = has_default ? shortNumber(value) : "none";
  added.json["default"] = has_default ? Json(value) : Json(nullptr);
  if (std::isfinite(range.low)) added.json[range.low_open ? "exclusive_minimum" : "minimum"] = range.low;
  if (std::isfinite(range.high)) added.json["maximum"] = range.high;
  return {*this, added.entry.name};
}

namespace {

std::string wholeRange(std::uint64_t low, std::uint64_t high) {
  constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();
  return std::to_string(low) + (high == kNoLimit ? " or more" : " to " + std::to_string(high));
}

auto storeInteger(std::uint64_t& value, std::uint64_t low, std::uint64_t high) {
  return [&value, low, high](const OptionValue& asked) -> std::string {
    // Text that is no whole number arrives as text.
    const std::uint64_t* const number = std::get_if<std::uint64_t>(&asked);
    if (number == nullptr || *number < low || *number > high)
      return "is not a whole number in the range " + wholeRange(low, high);
    value = *number;
    return {};
  };
}

}  // namespace

void OptionTable::integerArgument(const std::string& name, std::uint64_t& value, std::uint64_t low, std::uint64_t high,
                                  const std::string& help) {
  impl_->addArgument(name, help, OptionKind::Integer, wholeRange(low, high)).store = storeInteger(value, low, high);
}

OptionTable::Option OptionTable::integer(const OptionNames& names, std::uint64_t& value, const std::string& unit,
                                         std::uint64_t low, std::uint64_t high, const std::string& help) {
  constexpr std::uint64_t kNoLimit = std::numeric_limits<std::uint64_t>::max();
  const bool has_default = value != kNoLimit;
  Impl::Declared& added = impl_->add(names, OptionKind::Integer, unit, help, wholeRange(low, high));
  added.initial = value;
  added.store = storeInteger(value, low, high);
  added.entry.shown_default = has_default ? std::to_string(value) : "none";
  added.json["default"] = has_default ? Json(value) : Json(nullptr);
  added.json["minimum"] = low;
  if (high != kNoLimit) added.json["maximum"] = high;
  return {*this, added.entry.name};
}

OptionTable::Option OptionTable::numbers(const OptionNames& names, const std::string& unit, bool multiple,
                                         const StoreNumbers& store, const std::string& help) {
  Impl::Declared& added = impl_->add(names, OptionKind::Numbers, unit, help);
  added.numbers = 1 + static_cast<std::size_t>(std::ranges::count(unit, ','));
  added.initial = std::vector<double>{};
  added.store = [store, count = added.numbers, unit](const OptionValue& asked) -> std::string {
    // Text that is no list of numbers arrives as text.
    const std::vector<double>* const list = std::get_if<std::vector<double>>(&asked);
    const auto isNumber = [](double number) { return isComputable(number) || std::isinf(number); };
    if (list == nullptr || (!list->empty() && list->size() != count) || !std::ranges::all_of(*list, isNumber))
      return "is not " + unit + ", " + std::to_string(count) + " numbers that coordinates can have";
    return store(*list);
  };
  added.entry.multiple = multiple;
  if (multiple) {
    added.json["multiple"] = true;
    added.json["required"] = false;
  } else {
    added.json["default"] = nullptr;
  }
  return {*this, added.entry.name};
}

OptionTable::Option OptionTable::text(const OptionNames& names, std::string& value, const std::string& unit,
                                      const std::string& help) {
  Impl::Declared& added = impl_->addText(names, value, unit, help);
  added.entry.shown_default = value;
  added.json["default"] = value.empty() ? Json(nullptr) : Json(value);
  return {*this, added.entry.name};
}

OptionTable::Option OptionTable::requiredText(const OptionNames& names, std::string& value, const std::string& unit,
                                              const std::string& help) {
  Impl::Declared& added = impl_->addText(names, value, unit, help);
  added.entry.required = true;
  added.json["required"] = true;
  return {*this, added.entry.name};
}

OptionTable::Option OptionTable::texts(const OptionNames& names, std::vector<std::string>& values,
                                       const std::string& unit, bool required, const std::string& help) {
  Impl::Declared& added = impl_->add(names, isFile(unit) ? OptionKind::File : OptionKind::Text, unit, help);
  added.initial = std::string{};
  added.store = [&values](const OptionValue& given) {
    values.push_back(std::get<std::string>(given));
    return std::string{};
  };
  added.entry.multiple = true;
  added.entry.required = required;
  added.json["multiple"] = true;
  added.json["required"] = required;
  return {*this, added.entry.name};
}

OptionTable::Option OptionTable::textsWithFiles(const OptionNames& names, const std::string& unit,
                                                const StoreText& store, const FilesIn& files, const std::string& help) {
  Impl::Declared& added = impl_->add(names, OptionKind::Text, unit, help);
  added.initial = std::string{};
  added.store = [store](const OptionValue& given) { return store(std::get<std::string>(given)); };
  added.reads = true;
  added.files_in = files;
  added.entry.multiple = true;
  added.json["multiple"] = true;
  added.json["required"] = false;
  return {*this, added.entry.name};
}

OptionTable::Option OptionTable::choice(const OptionNames& names, std::string& value,
                                        const std::vector<std::string>& choices, const std::string& help) {
  return choice(
      names, value, choices, [&value](const std::string& chosen) { value = chosen; }, help);
}

OptionTable::Option OptionTable::choice(const OptionNames& names, const std::string& initial,
                                        const std::vector<std::string>& choices,
                                        const std::function<void(const std::string&)>& store, const std::string& help) {
  Impl::Declared& added = impl_->add(names, OptionKind::Choice, {}, help);
  added.initial = initial;
  added.store = [store, choices](const OptionValue& given) -> std::string {
    const std::string& chosen = std::get<std::string>(given);
    if (std::ranges::find(choices, chosen) == choices.end()) return "is none of " + joined(choices, ", ");
    store(chosen);
    return {};
  };
  added.entry.choices = choices;
  added.entry.shown_unit = joined(choices, "|");
  added.entry.shown_default = initial;
  added.json["default"] = initial;
  added.json["choices"] = choices;
  return {*this, added.entry.name};
}

OptionTable::Option OptionTable::flag(const OptionNames& names, bool& value, const std::string& help, bool* given) {
  const bool with_opposite = names.typed.find('!') != std::string::npos;
  Impl::Declared& added = impl_->add(names, OptionKind::Flag, {}, help, with_opposite ? (value ? "on" : "off") : "");
  added.initial = value;
  added.store = [&value, given](const OptionValue& asked) {
    value = std::get<bool>(asked);
    if (given != nullptr) *given = true;
    return std::string{};
  };
  added.json["default"] = value;
  return {*this, added.entry.name};
}

OptionTable::Option OptionTable::file(const OptionNames& names, const std::string& help) {
  Impl::Declared& added = impl_->add(names, OptionKind::File, "FILE", help);
  added.initial = std::string{};
  added.store = [](const OptionValue&) { return std::string{}; };
  added.json["default"] = nullptr;
  return {*this, added.entry.name};
}

void OptionTable::needing(const std::vector<std::string>& others, const std::function<void()>& declare) {
  const std::size_t first = impl_->all.size();
  declare();
  for (std::size_t i = first; i < impl_->all.size(); ++i) Option(*this, impl_->all[i]->entry.name).needs(others);
}

OptionTable::Option OptionTable::output(const OptionNames& names, std::string& value, OutputKind kind,
                                        const std::string& help) {
  const Option option =
      kind.required ? requiredText(names, value, kOutputFile, help) : text(names, value, kOutputFile, help);
  impl_->declared(option.name_).writes = std::move(kind);
  return option;
}

OptionTable::Option OptionTable::outputs(const OptionNames& names, std::vector<std::string>& values, OutputKind kind,
                                         const std::string& help) {
  const Option option = texts(names, values, kOutputFile, kind.required, help);
  impl_->declared(option.name_).writes = std::move(kind);
  return option;
}

void OptionTable::example(const std::string& command, const std::string& help) {
  impl_->examples.push_back({{"command", command}, {"help", help}});
}

std::vector<const OptionTable::Entry*> OptionTable::entries() const {
  std::vector<const Entry*> entries;
  for (const Impl::Declared* one : impl_->shown()) entries.push_back(&one->entry);
  return entries;
}

const std::string& OptionTable::name() const { return impl_->name; }
const std::string& OptionTable::help() const { return impl_->help; }

std::string OptionTable::examplesText() const {
  if (impl_->examples.empty()) return {};
  std::string text = "Examples:";
  for (const Json& example : impl_->examples)
    text += "\n  " + example["help"].get<std::string>() + "\n    " + example["command"].get<std::string>();
  return text + "\n";
}

std::string OptionTable::jsonUsage() const { return impl_->usage().dump(2) + "\n"; }

void OptionTable::set(const std::string& name, const OptionValue& value, const std::string& shown) {
  Impl::Declared& option = impl_->declared(name);
  if (const std::string wrong = option.store(value); !wrong.empty()) throw OptionError("'" + shown + "' " + wrong);
  OptionValue kept = value;
  option.given.push_back(std::move(kept));
}

void OptionTable::setText(const std::string& name, const std::string& text) {
  // Most likely a shell variable that is not set: ignoring the option would make another mesh.
  if (text.empty()) throw OptionError("'' is an empty text; leave it out");
  set(name, valueOf(text, impl_->declared(name).entry.kind), text);
}

const std::vector<OptionValue>& OptionTable::given(const std::string& name) const {
  return impl_->declared(name).given;
}

std::vector<std::string> OptionTable::missing() const {
  std::vector<std::string> names;
  for (const auto& option : impl_->all) {
    const bool spared = option->spared && option->spared();
    if (option->entry.required && option->given.empty() && !spared) names.push_back(option->entry.name);
  }
  return names;
}

std::vector<OptionTable::NamedFile> OptionTable::inputs() const {
  std::vector<NamedFile> named;
  for (const auto& option : impl_->all) {
    if (!option->reads) continue;
    for (const OptionValue& value : option->given) {
      const std::string& text = std::get<std::string>(value);
      for (const std::string& path : option->files_in ? option->files_in(text) : std::vector{text})
        if (!path.empty() && path != "-") named.push_back({option->entry.name, path});
    }
  }
  return named;
}

std::vector<OptionTable::NamedOutput> OptionTable::outputs() const {
  std::vector<NamedOutput> named;
  for (const auto& option : impl_->all) {
    if (!option->writes) continue;
    const std::string& name = option->entry.name;
    for (const OptionValue& value : option->given) {
      const std::string& path = std::get<std::string>(value);
      if (path.empty() && !option->entry.multiple) continue;
      if (path == "-" && option->writes->standard_output) continue;
      if (path == "-")
        throw OptionError(name +
                          " -: this cannot be written to standard output; name a file, a file called '-' as ./-");
      named.push_back({name, path, option->writes->files ? option->writes->files(path) : OutputFiles{{path}, {}, {}}});
    }
  }
  return named;
}

std::vector<std::string> OptionTable::withoutEffect() const {
  std::vector<std::string> sentences;
  for (const auto& [option, holds, else_text] : impl_->conditions) {
    const bool effective = holds();  // also for options not given, so that a faulty condition shows
    if (!effective && impl_->given(option)) sentences.push_back(option + " has no effect " + else_text);
  }
  return sentences;
}

}  // namespace coastmesh
