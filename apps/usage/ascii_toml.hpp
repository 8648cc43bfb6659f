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

// A TOML document of the same values and lines in ASCII: what lies beyond is escaped in texts and struck out of
// comments. toml++ 3.3 meets undefined behaviour where it looks for the end of a value and finds such a letter.
struct AsciiToml {
  std::string text;
  std::size_t dots = 0;            // outside of texts and comments
  std::optional<TomlFault> fault;  // the first one; the text then ends before it
};

AsciiToml toAsciiToml(std::string_view document);

}  // namespace coastmesh
