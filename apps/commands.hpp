#pragma once

#include <functional>
#include <string>
#include <vector>

#include "apps/command_line.hpp"
#include "apps/interrupt.hpp"

namespace coastmesh {

// A verb of the program: its options, bound to variables of its own, and what it does. `run` returns an exit code and
// throws what main turns into messages and codes.
struct Command {
  CommandLine line;
  std::function<int(Interrupt&)> run;
};

Command declareMesh(CLI::App& root);
Command declareCheck(CLI::App& root);
Command declareInfo(CLI::App& root);
Command declarePlot(CLI::App& root);
Command declareConvert(CLI::App& root);
Command declareClean(CLI::App& root);

}  // namespace coastmesh
