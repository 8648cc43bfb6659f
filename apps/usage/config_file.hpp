#pragma once

#include <set>
#include <string>
#include <vector>

#include "apps/usage/option_table.hpp"

namespace coastmesh {

// Sets a command's options from a file: options by their long names without dashes, arguments by their names in small
// letters, at the top or in a section named like the command; sections of other `commands` are skipped. What was given
// before takes precedence. Adds a sentence to `warnings` for each option that goes by a former name. Throws
// OptionError, which names the file and the option: like readConfigEntries; for an option that the command does not
// have, that is given twice, or whose value is invalid; for a section that no command has.
void takeConfig(const std::string& file, OptionTable& table, const std::set<std::string>& commands,
                std::vector<std::string>& warnings);

}  // namespace coastmesh
