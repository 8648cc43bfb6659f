#include "gis/error.hpp"

#include "gis/secrets.hpp"

namespace coastmesh {

std::string oneLine(std::string_view text, std::size_t longest) {
  std::string line;
  bool blank = false;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte <= ' ' || byte == 0x7F) {
      blank = true;
      continue;
    }
    if (blank && !line.empty()) line += ' ';
    blank = false;
    line += c;
  }
  line = withoutSecrets(line);
  if (line.size() <= longest) return line;
  std::size_t end = line.rfind(' ', longest);
  if (end == std::string::npos || end == 0) {
    // A single word is cut between UTF-8 characters: their continuation bytes begin with 10.
    end = longest;
    while (end > 0 && (static_cast<unsigned char>(line[end]) & 0xC0) == 0x80) --end;
  }
  return line.substr(0, end) + "…";
}

}  // namespace coastmesh
