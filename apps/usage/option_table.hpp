#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "apps/usage/option_value.hpp"
#include "gis/error.hpp"
#include "gis/file/output_files.hpp"

namespace coastmesh {

// Headings under which options are shown, in this order.
enum class Section { Input, Domain, Triangles, Sizes, Coast, Depths, Boundaries, Picture, Output, Run };
const char* sectionTitle(Section section);

// The names of an option.
struct OptionNames {
  OptionNames(const char* as_typed, std::string as_read = {}) : typed(as_typed), label(std::move(as_read)) {}
  std::string typed;  // as typed: "-o,--output"
  std::string label;  // as shown, for example in a dialog of QGIS: "Bounding box"; unique within a table
};

// Label and help in one text: "Bounding box: mesh only ..."; only the help if it begins with the label: "Smallest angle
// asked for". `mark` is put before and after the label.
std::string saidOf(const std::string& label, const std::string& help, const std::string& mark = {});

struct NumberRange {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;  // `low` itself is out
};

// Units of options that name files to read, shown as FILE. The text after the colon is their role in --json-usage
// ("FILE" alone: "input"), so that programs can offer layers of that kind. Files to write are declared by `output` and
// `outputs`.
inline constexpr const char* kVectorFile = "FILE:vector";
inline constexpr const char* kRasterFile = "FILE:raster";

// The options of a job or a command. Each is declared once, by one call: the declaration checks and stores its values,
// and is shown by --help, --json-usage, Python and QGIS. An option's default is the value of its variable at the
// declaration; variables must outlive the table. The table does not depend on how options are given: see
// command_line.hpp for arguments of a program, option_keywords.hpp for keywords.
class OptionTable {
 public:
  OptionTable(const std::string& name, const std::string& help);
  ~OptionTable();
  OptionTable(OptionTable&&) noexcept;

  // A declared option, to define when it has an effect. There is a warning if it is given without: see `withoutEffect`.
  class Option {
   public:
    // It has an effect only if one of `others` is given, with a value other than its default; "--coast follow" stands
    // for that option with that value. If `in_place` is given, it also has an effect if that returns true once all is
    // set.
    const Option& needs(std::vector<std::string> others, const std::function<bool()>& in_place = {}) const;
    // It has no effect if one of `others` is given.
    const Option& ignoredWith(std::vector<std::string> others) const;
    // It has an effect only if `holds` returns true once all is set; `else_text` follows "has no effect ".
    const Option& needs(std::function<bool()> holds, const std::string& else_text) const;
    // Its names in the last version, in the same order.
    const Option& formerly(const std::vector<std::string>& names) const;

   private:
    friend class OptionTable;
    Option(OptionTable& table, std::string name) : table_(&table), name_(std::move(name)) {}
    OptionTable* table_;
    std::string name_;
  };

  // Declarations -----------------------------------------------------------------------------------------------------

  // Positional arguments. Names are as the help shows them: "INPUT".
  void argument(const std::string& name, std::string& value, const std::string& help);
  // `spared`, if not empty, is called once all is set: if it returns true, none need be given.
  void arguments(const std::string& name, std::vector<std::string>& values, const std::string& help,
                 const std::function<bool()>& spared = {});
  // An argument that is a whole number, not a file.
  void integerArgument(const std::string& name, std::uint64_t& value, std::uint64_t low, std::uint64_t high,
                       const std::string& help);

  // The heading of the options that are declared from here on; before the first call it is Section::Run.
  void section(Section section);

  // Options. `unit` is the unit of the value ("DEG", "M"), or its kind ("FILE"). Numbers must be within their range and
  // `isComputable`; an infinite default, or the largest integer, means none. `given`, if not null, becomes true when
  // the user gives the option.
  Option number(const OptionNames& names, double& value, const std::string& unit, const NumberRange& range,
                const std::string& help, bool* given = nullptr);
  Option integer(const OptionNames& names, std::uint64_t& value, const std::string& unit, std::uint64_t low,
                 std::uint64_t high, const std::string& help);
  // As many numbers as `unit` names: "W,S,E,N". `store` receives that many, or none if the given list is empty, and
  // returns what is wrong with them as the end of a sentence about them ("is not ..."), empty if nothing. `multiple`:
  // the option may be repeated, and `store` is called for each.
  using StoreNumbers = std::function<std::string(const std::vector<double>&)>;
  Option numbers(const OptionNames& names, const std::string& unit, bool multiple, const StoreNumbers& store,
                 const std::string& help);
  Option text(const OptionNames& names, std::string& value, const std::string& unit, const std::string& help);
  // `values` is empty when declared.
  Option texts(const OptionNames& names, std::vector<std::string>& values, const std::string& unit, bool required,
               const std::string& help);
  // Texts that name files to read among other things: `files` returns these. `store` returns what is wrong with a text
  // as the end of a sentence about it ("is not ..."), empty if nothing.
  using StoreText = std::function<std::string(const std::string&)>;
  using FilesIn = std::function<std::vector<std::string>(const std::string&)>;
  Option textsWithFiles(const OptionNames& names, const std::string& unit, const StoreText& store, const FilesIn& files,
                        const std::string& help);
  Option requiredText(const OptionNames& names, std::string& value, const std::string& unit, const std::string& help);
  Option choice(const OptionNames& names, std::string& value, const std::vector<std::string>& choices,
                const std::string& help);
  // The same for a value that is not text: `store` receives the user's choice.
  Option choice(const OptionNames& names, const std::string& initial, const std::vector<std::string>& choices,
                const std::function<void(const std::string&)>& store, const std::string& help);
  // "--coarsen,!--no-coarsen" declares a flag and its opposite.
  Option flag(const OptionNames& names, bool& value, const std::string& help, bool* given = nullptr);

  // A file that the caller who fills the table reads: nothing is stored.
  Option file(const OptionNames& names, const std::string& help);

  // An option that is declared already, by its longest name.
  Option option(const std::string& name) { return {*this, name}; }
  // All options that `declare` declares need one of `others`.
  void needing(const std::vector<std::string>& others, const std::function<void()>& declare);

  // Files to write. `files` returns all files of a given path; empty: only the file of that name. `standard_output`:
  // "-" is allowed and means standard output.
  using FilesOf = std::function<OutputFiles(const std::string& path)>;
  struct OutputKind {
    bool required = false;
    FilesOf files = {};
    bool standard_output = false;
  };
  Option output(const OptionNames& names, std::string& value, OutputKind kind, const std::string& help);
  Option outputs(const OptionNames& names, std::vector<std::string>& values, OutputKind kind, const std::string& help);

  // A command line as a user might type it, and what it does.
  void example(const std::string& command, const std::string& help);

  // What was declared ------------------------------------------------------------------------------------------------

  struct Entry {
    std::string name;   // the longest; of a flag with an opposite, the one that turns it on
    std::string names;  // all of them, as declared
    std::string label;
    Section section = Section::Run;
    OptionKind kind = OptionKind::Text;
    bool multiple = false;
    bool required = false;
    std::string shown_unit;
    std::string shown_help;     // after its label, with its range
    std::string shown_default;  // empty: none is shown
    std::vector<std::string> choices;
    std::vector<std::pair<std::string, std::string>> former_names;  // each with its present name
    bool argument = false;                                          // positional
  };
  // As they are shown: arguments first, then by sections, and in the order of declaration.
  std::vector<const Entry*> entries() const;
  const std::string& name() const;
  const std::string& help() const;
  std::string examplesText() const;  // empty without examples
  // The declarations as a JSON object, indented.
  std::string jsonUsage() const;

  // Values -----------------------------------------------------------------------------------------------------------

  // Gives an option, by `Entry::name`, a value of its kind, or a text to be read as one. `shown`: what the user gave,
  // for messages. Throws OptionError, which says what is wrong with the value; the caller adds the name of the option.
  void set(const std::string& name, const OptionValue& value, const std::string& shown);
  void setText(const std::string& name, const std::string& text);

  // All values that an option or argument was given, by `Entry::name`.
  const std::vector<OptionValue>& given(const std::string& name) const;

  // Once all is set: the required options and arguments that were not given.
  std::vector<std::string> missing() const;

  // Once all is set: the files to read and to write that arguments and options name. Throws OptionError for "-" where
  // standard output is not allowed, and what `FilesOf` throws.
  struct NamedFile {
    std::string option, path;
  };
  struct NamedOutput {
    std::string option, path;
    OutputFiles files;
  };
  std::vector<NamedFile> inputs() const;
  std::vector<NamedOutput> outputs() const;

  // Once all is set: a sentence for each option that was given and has no effect.
  std::vector<std::string> withoutEffect() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace coastmesh
