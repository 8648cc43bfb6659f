#pragma once

#include <stdexcept>
#include <string>

namespace coastmesh {

// The input cannot be read or used (exit code 3). The text is one sentence: the file, the feature, the place, what to
// do.
struct InputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// An output cannot be written (exit code 4).
struct OutputError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace coastmesh
