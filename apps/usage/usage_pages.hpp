#pragma once

#include <string>
#include <vector>

namespace coastmesh {

// The forms of the program's usage, for manuals and shells: "man", "man:VERB", "markdown", "bash", "zsh", "fish".
std::vector<std::string> usageForms(const std::string& usage_json);

// The whole usage, as `coastmesh --json-usage` prints it, in one of these forms. Throws OptionError for any other.
std::string usageAs(const std::string& form, const std::string& usage_json);

}  // namespace coastmesh
