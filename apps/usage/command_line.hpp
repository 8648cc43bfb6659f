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

// Not an error: the text that --help, --version or --json-usage prints before the program ends.
struct UsageText {
  std::string text;
};

// The table of a command of the program, with --config declared; `CommandLine::complete` reads that file.
OptionTable commandOptions(const std::string& name, const std::string& help);

// A command of the program: its arguments fill a table of options.
class CommandLine {
 public:
  CommandLine(CLI::App& root, OptionTable table);
  ~CommandLine();
  CommandLine(CommandLine&&) noexcept;

  const OptionTable& options() const { return *table_; }
  bool chosen() const;  // true if this command was called

  // The words after the command's name, for the parser. Former names of options are replaced by present ones, with a
  // sentence for each in `warnings`; switches have true or false as value, if any; other values are words of their own.
  // Also warns of arguments that look like a second value of an option. Throws OptionError for a switch whose value is
  // no truth value.
  std::vector<std::string> toParse(const std::vector<std::string>& arguments, std::vector<std::string>& warnings) const;

  // To be called once the arguments are parsed: takes options that were not given from the file of --config (see
  // takeConfig). Also throws OptionError if a required option is in neither.
  void complete(const std::set<std::string>& commands, std::vector<std::string>& warnings);

 private:
  CLI::App* app_;
  std::unique_ptr<OptionTable> table_;  // the parser refers to its address
};

}  // namespace coastmesh
