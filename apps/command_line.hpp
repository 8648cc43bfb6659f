#pragma once

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace coastmesh {

// The command line asks for what cannot be (exit code 2).
struct UsageError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Not an error: the text that --help, --version or --json-usage asked for, to be printed before the program ends.
struct UsageText {
  std::string text;
};

struct NumberRange {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_open = false;  // `low` itself is out
};

// Units of options that name files, shown as FILE; what follows the colon is their role in --json-usage, where "FILE" alone
// says "input": programs offer layers of that kind, or ask before they replace a file.
inline constexpr const char* kOutputFile = "FILE:output";
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

  // Arguments told by their place. Names are as the help shows them: "INPUT".
  void argument(const std::string& name, std::string& value, const std::string& help);
  void arguments(const std::string& name, std::vector<std::string>& values, const std::string& help);

  // Options. Names are as CLI11 takes them: "-o,--output". `unit` is what the value is counted in ("DEG", "M"), or what
  // it is ("FILE"). Numbers must be finite and within their range; an infinite default, or
  // the greatest of integers, means none. `given`, where there
  // is one, becomes true when the user gives the option.
  void number(const std::string& names, double& value, const std::string& unit, const NumberRange& range,
              const std::string& help, bool* given = nullptr);
  void integer(const std::string& names, std::uint64_t& value, const std::string& unit, std::uint64_t low,
               std::uint64_t high, const std::string& help);
  void text(const std::string& names, std::string& value, const std::string& unit, const std::string& help);
  void texts(const std::string& names, std::vector<std::string>& values, const std::string& unit, bool required,
             const std::string& help);
  void requiredText(const std::string& names, std::string& value, const std::string& unit, const std::string& help);
  void choice(const std::string& names, std::string& value, const std::vector<std::string>& choices,
              const std::string& help);
  // The same for a value that is no text: `store` takes the user's choice.
  void choice(const std::string& names, const std::string& initial, const std::vector<std::string>& choices,
              const std::function<void(const std::string&)>& store, const std::string& help);
  // "--shrink,!--no-shrink" declares a flag and its opposite.
  void flag(const std::string& names, bool& value, const std::string& help, bool* given = nullptr);

  // A command line as a user might type it, and what it does; shown below the options.
  void example(const std::string& command, const std::string& help);

  const std::string& name() const;
  bool chosen() const;  // whether this command is the one that was called

  // The declarations as a JSON object, indented.
  std::string jsonUsage() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace coastmesh
