#pragma once

#include <algorithm>
#include <string>

namespace coastmesh {

// ASCII letters in lower case, in any locale; all other bytes are unchanged.
inline std::string lowerCase(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  return text;
}

}  // namespace coastmesh
