#pragma once

namespace coastmesh {

// What the program's caller can count on; never to change.
enum ExitCode : int {
  kExitDone = 0,
  kExitShort = 1,        // done, but short of what was asked
  kExitUsage = 2,        // wrong usage
  kExitInput = 3,        // input unreadable or unusable
  kExitOutput = 4,       // output could not be written
  kExitInterrupted = 5,  // SIGINT, SIGTERM or SIGHUP: no partial file left
  kExitBug = 70,         // a bug of coastmesh
};

}  // namespace coastmesh
