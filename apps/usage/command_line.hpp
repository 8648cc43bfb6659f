#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "apps/usage/option_table.hpp"

namespace CLI {
class App;
}

namespace coastmesh {

// Not an error: the text that --help, --version or --json-usage asked for, to be printed before the program ends.
struct UsageText {
  std::string text;
};

// A table for a command of the program, which begins with --config: `CommandLine::complete` reads what that names.
OptionTable commandOptions(const std::string& name, const std::string& help);

// A command of the program: its arguments fill a table of options.
class CommandLine {
 public:
  CommandLine(CLI::App& root, OptionTable table);
  ~CommandLine();
  CommandLine(CommandLine&&) noexcept;

  const OptionTable& options() const { return *table_; }
  bool chosen() const;  // whether this command is the one that was called

  // What follows the command's name, as words to be parsed. Options that go by a former name are called as they are
  // now, with a sentence for each in `warnings`; switches have true or false for a value, if any; other values are
  // words of their own. Throws OptionError for a switch whose value is no truth value.
  std::vector<std::string> toParse(const std::vector<std::string>& arguments, std::vector<std::string>& warnings) const;

  // Once the arguments are parsed: takes what they leave open from the file that --config names (see takeConfig).
  // Throws OptionError besides where something that must be given is in neither.
  void complete(const std::set<std::string>& commands, std::vector<std::string>& warnings);

 private:
  CLI::App* app_;
  std::unique_ptr<OptionTable> table_;  // its address is in what parses
};

}  // namespace coastmesh
