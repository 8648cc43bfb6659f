#pragma once

#include <set>
#include <string>
#include <vector>

#include "apps/usage/option_table.hpp"

namespace coastmesh {

// Gives a command's options what a file of options says of them: options by their long names without dashes, arguments
// by theirs in small letters, at the top or in a section named as the command; sections of other `commands` are passed
// over. What was given before goes before the file. A sentence for each option that goes by a former name goes to
// `warnings`. Throws OptionError, which names the file and the option: see readConfigEntries; an option that the
// command does not have, that is given twice, or whose value it does not take; a section that no command has.
void takeConfig(const std::string& file, OptionTable& table, const std::set<std::string>& commands,
                std::vector<std::string>& warnings);

}  // namespace coastmesh
