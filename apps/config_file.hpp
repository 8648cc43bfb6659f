#pragma once

#include <string>
#include <vector>

namespace coastmesh {

// Replaces `--config FILE` among the arguments that follow a command's name by what the file says: options by their long names without
// dashes, arguments by theirs in small letters, at the top or in a section named as the command; sections of other commands are passed
// over. What the command line gives itself goes before the file. A file that ends in .json is JSON, any other TOML. `usage` is the
// command's declaration as JSON. Throws UsageError: no such file, not of its format, an option that the command does not have.
std::vector<std::string> expandConfig(const std::vector<std::string>& arguments, const std::string& usage);

}  // namespace coastmesh
