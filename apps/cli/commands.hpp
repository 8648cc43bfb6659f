#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/cli/interrupt.hpp"
#include "apps/usage/command_line.hpp"

namespace coastmesh {

class Cluster;

// What a run of a command is given besides its options.
struct Run {
  Interrupt& interrupt;
  Cluster* cluster;                   // the other ranks of the run; null where there are none
  std::vector<std::string> inputs;    // all files that the run reads
  std::vector<std::string> warnings;  // printed already; for the report
  const OptionTable& options;         // all that was given

  void warn(const std::string& text);  // prints a line on standard error, and notes it
};

// A verb of the program: its options, bound to variables of its own, and what it does. `run` returns an exit code and
// throws what main turns into messages and codes.
struct Command {
  CommandLine line;
  std::function<int(Run&)> run;
};

Command declareMesh(CLI::App& root);
Command declareCheck(CLI::App& root);
Command declareInfo(CLI::App& root);
Command declarePlot(CLI::App& root);
Command declareConvert(CLI::App& root);
Command declareClean(CLI::App& root);
Command declarePartition(CLI::App& root);
Command declareGather(CLI::App& root);

}  // namespace coastmesh
