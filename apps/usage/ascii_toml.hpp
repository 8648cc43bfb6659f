#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace coastmesh {

struct TomlFault {
  std::size_t at = 0;  // byte of the document
  std::string why;
};

// A TOML document with the same values and lines in ASCII: other letters are escaped in strings and replaced in
// comments. toml++ 3.3 has undefined behaviour if it meets such a letter while it looks for the end of a value.
struct AsciiToml {
  std::string text;
  std::size_t dots = 0;            // outside strings and comments
  std::optional<TomlFault> fault;  // the first one; the text then ends before it
};

AsciiToml toAsciiToml(std::string_view document);

}  // namespace coastmesh
