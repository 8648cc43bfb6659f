#pragma once

#include <set>
#include <string>
#include <vector>

namespace coastmesh {

// Adds to the arguments that follow a command's name what `--config FILE` among them says: options by their long names
// without dashes, arguments by theirs in small letters, at the top or in a section named as the command; sections of
// other `commands` are passed over. What the command line gives itself goes before the file. `usage` is the command's
// declaration as JSON. Throws OptionError: see readConfigEntries; an option that the command does not have, or that is
// given twice.
std::vector<std::string> expandConfig(const std::vector<std::string>& arguments, const std::string& usage,
                                      const std::set<std::string>& commands);

}  // namespace coastmesh
