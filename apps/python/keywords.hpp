#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "apps/usage/option_table.hpp"

namespace coastmesh {

// Gives the options that keywords name their values; None leaves one as it is. Values are Python's own or numpy's:
// True and False, numbers, texts, paths, a CRS of pyproj, lists of numbers, and for options that may be repeated lists
// of these. A text is taken for a number too where it is one. A sentence for each keyword that has another name now
// goes to `warnings`. Throws OptionError, which names the keyword.
void setFromKeywords(OptionTable& table, const pybind11::dict& keywords, std::vector<std::string>& warnings);

}  // namespace coastmesh
