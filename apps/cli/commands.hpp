#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/process/interrupt.hpp"
#include "apps/usage/command_line.hpp"

namespace coastmesh {

class Cluster;

// The context in which a command runs.
struct Run {
  Interrupt& interrupt;
  Cluster* cluster;                   // the other ranks of the run; null if there are none
  std::vector<std::string> inputs;    // all files that the run reads
  std::vector<std::string> warnings;  // printed already; for the report
  const OptionTable& options;         // all that were given

  void warn(const std::string& text);  // prints a line on standard error, and notes it
};

// A command of the program: its options, bound to its own variables, and its action. `run` returns an exit code; main
// turns its exceptions into messages and codes.
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
Command declareCut(CLI::App& root);
Command declareRemesh(CLI::App& root);
Command declareMerge(CLI::App& root);
Command declareRivers(CLI::App& root);
Command declarePartition(CLI::App& root);
Command declareGather(CLI::App& root);

}  // namespace coastmesh
