#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "gis/error.hpp"
#include "gis/file/output_files.hpp"

namespace CLI {
class App;
}

namespace coastmesh {

// Not an error: the text that --help, --version or --json-usage asked for, to be printed before the program ends.
struct UsageText {
  std::string text;
};

struct NumberRange {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;  // `low` itself is out
};

// Units of options that name files to read, shown as FILE; what follows the colon is their role in --json-usage, where
// "FILE" alone says "input": programs offer layers of that kind. Files to write are declared by `output` and `outputs`.
inline constexpr const char* kVectorFile = "FILE:vector";
inline constexpr const char* kRasterFile = "FILE:raster";

// The options of one command. Each is declared once, by one call: that declaration parses it, checks it, and is what
// --help and --json-usage print. An option's default is what its variable holds when it is declared; the variables must
// outlive the parsing.
class CommandLine {
 public:
  CommandLine(CLI::App& root, const std::string& name, const std::string& help);
  ~CommandLine();
  CommandLine(CommandLine&&) noexcept;

  // An option that was declared, to say when it counts. Given without what it needs, it is warned of: see
  // `withoutEffect`.
  class Option {
   public:
    // It has an effect only where one of `others` is given besides, and is not what it is by default; "--coast follow"
    // stands for that option given as that.
    const Option& needs(std::vector<std::string> others) const;
    // It has no effect where one of `others` is given.
    const Option& ignoredWith(std::vector<std::string> others) const;
    // It has an effect only where `holds`, once parsed, says so; `else_text` follows "has no effect ".
    const Option& needs(std::function<bool()> holds, const std::string& else_text) const;
    // What its names were called in the last version, in the same order: see `withPresentNames`.
    const Option& formerly(const std::vector<std::string>& names) const;

   private:
    friend class CommandLine;
    Option(CommandLine& line, std::string name) : line_(&line), name_(std::move(name)) {}
    CommandLine* line_;
    std::string name_;
  };

  // Arguments known by their place. Names are as the help shows them: "INPUT".
  void argument(const std::string& name, std::string& value, const std::string& help);
  void arguments(const std::string& name, std::vector<std::string>& values, const std::string& help);

  // Options. Names are as CLI11 takes them: "-o,--output". `unit` is what the value is counted in ("DEG", "M"), or what
  // it is ("FILE"). Numbers must be within their range and `isComputable`; an infinite default, or
  // the greatest of integers, means none. `given`, where there
  // is one, becomes true when the user gives the option.
  Option number(const std::string& names, double& value, const std::string& unit, const NumberRange& range,
                const std::string& help, bool* given = nullptr);
  Option integer(const std::string& names, std::uint64_t& value, const std::string& unit, std::uint64_t low,
                 std::uint64_t high, const std::string& help);
  Option text(const std::string& names, std::string& value, const std::string& unit, const std::string& help);
  // The same for a value that is no text: `store` takes what the user gave, and throws OptionError where it cannot.
  Option text(const std::string& names, const std::string& unit, const std::function<void(const std::string&)>& store,
              const std::string& help);
  Option texts(const std::string& names, std::vector<std::string>& values, const std::string& unit, bool required,
               const std::string& help);
  Option requiredText(const std::string& names, std::string& value, const std::string& unit, const std::string& help);
  Option choice(const std::string& names, std::string& value, const std::vector<std::string>& choices,
                const std::string& help);
  // The same for a value that is no text: `store` takes the user's choice.
  Option choice(const std::string& names, const std::string& initial, const std::vector<std::string>& choices,
                const std::function<void(const std::string&)>& store, const std::string& help);
  // "--coarsen,!--no-coarsen" declares a flag and its opposite.
  Option flag(const std::string& names, bool& value, const std::string& help, bool* given = nullptr);

  // One that is declared already, by its longest name.
  Option option(const std::string& name) { return {*this, name}; }
  // All that `declare` declares needs one of `others`.
  void needing(const std::vector<std::string>& others, const std::function<void()>& declare);

  // Files to write. `files` says all that a path given stands for; empty: the file of that name alone.
  // `standard_output`: "-" is allowed and means it.
  using FilesOf = std::function<OutputFiles(const std::string& path)>;
  struct OutputKind {
    bool required = false;
    FilesOf files = {};
    bool standard_output = false;
  };
  Option output(const std::string& names, std::string& value, OutputKind kind, const std::string& help);
  Option outputs(const std::string& names, std::vector<std::string>& values, OutputKind kind, const std::string& help);

  // A command line as a user might type it, and what it does; shown below the options.
  void example(const std::string& command, const std::string& help);

  const std::string& name() const;
  bool chosen() const;  // whether this command is the one that was called

  // What follows the command's name, with options that go by a former name called as they are now, to be parsed; a
  // sentence for each goes to `warnings`.
  std::vector<std::string> withPresentNames(std::vector<std::string> arguments,
                                            std::vector<std::string>& warnings) const;

  // Once parsed: the files to read that arguments and options name, whichever they are, and those to write. Throws
  // OptionError for "-" where standard output is not allowed, and what `FilesOf` throws.
  struct NamedFile {
    std::string option, path;
  };
  struct NamedOutput {
    std::string option, path;
    OutputFiles files;
  };
  std::vector<NamedFile> inputs() const;
  std::vector<NamedOutput> outputs() const;

  // Once parsed: a sentence for each option that was given and has no effect.
  std::vector<std::string> withoutEffect() const;

  // The declarations as a JSON object, indented.
  std::string jsonUsage() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace coastmesh
