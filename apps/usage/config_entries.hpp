#pragma once

#include <string>
#include <vector>

namespace coastmesh {

// An entry of a file of options; values are texts as a user would type them.
struct ConfigEntry {
  std::string section;  // empty at the top
  std::string name;
  bool list = false;                             // the value is a list
  std::vector<std::vector<std::string>> values;  // its items, each a list for a list of lists; otherwise a single text
};

// The contents of a file of options, in order.
struct ConfigEntries {
  std::vector<std::string> sections;  // empty ones too
  std::vector<ConfigEntry> entries;
};

// Reads a file of options: JSON if its name ends in .json, otherwise TOML. Throws OptionError if the file does not
// exist or has another format, if lists or sections are nested deeper than options are, or if a name is given twice.
ConfigEntries readConfigEntries(const std::string& file);

}  // namespace coastmesh
