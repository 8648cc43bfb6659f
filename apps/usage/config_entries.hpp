#pragma once

#include <string>
#include <vector>

namespace coastmesh {

// An entry of a file of options; values are texts as a user would type them.
struct ConfigEntry {
  std::string section;  // empty at the top
  std::string name;
  bool list = false;  // the value is a list
  std::vector<std::vector<std::string>>
      values;  // its items, a list each where it is a list of lists; one of one text where it is none
};

// What a file of options holds, in its order.
struct ConfigEntries {
  std::vector<std::string> sections;  // empty ones too
  std::vector<ConfigEntry> entries;
};

// Reads a file of options: JSON where its name ends in .json, else TOML. Throws OptionError: no such file, not of its
// format, lists or sections nested deeper than options are, a name given twice.
ConfigEntries readConfigEntries(const std::string& file);

}  // namespace coastmesh
