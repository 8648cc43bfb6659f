#pragma once

namespace coastmesh {

// Callers of the program rely on these: never change them.
enum ExitCode : int {
  kExitDone = 0,
  kExitShort = 1,        // done, but a requirement is missed
  kExitUsage = 2,        // wrong usage
  kExitInput = 3,        // input unreadable or unusable
  kExitOutput = 4,       // output could not be written
  kExitInterrupted = 5,  // SIGINT, SIGTERM or SIGHUP: no partial file left
  kExitBug = 70,         // a bug of coastmesh
};

}  // namespace coastmesh
