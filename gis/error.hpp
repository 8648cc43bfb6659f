#pragma once

#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>

namespace coastmesh {

// `text` as one line for people: runs of white space and control characters become one blank, and there are no secrets
// in it (gis/secrets.hpp). Text of more than `longest` bytes is cut after a word, with "…".
std::string oneLine(std::string_view text, std::size_t longest = std::numeric_limits<std::size_t>::max());

// Options request something impossible, for any input (exit code 2).
struct OptionError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The input cannot be read or used (exit code 3). The text is one sentence on one line: the file, the feature, the
// place, what to do.
struct InputError : std::runtime_error {
  explicit InputError(const std::string& text) : std::runtime_error(oneLine(text)) {}
};

// An output cannot be written (exit code 4). One line as well.
struct OutputError : std::runtime_error {
  explicit OutputError(const std::string& text) : std::runtime_error(oneLine(text)) {}
};

}  // namespace coastmesh
