#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "apps/usage/option_table.hpp"

namespace coastmesh {

// Sets the options that keywords name; None leaves an option unchanged. Values are Python's or numpy's: True and False,
// numbers, texts, paths, a CRS of pyproj, lists of numbers, and for repeatable options lists of these. A text is
// accepted as a number if it is one. Adds a sentence to `warnings` for each keyword that is a former name. Throws
// OptionError, which names the keyword.
void setFromKeywords(OptionTable& table, const pybind11::dict& keywords, std::vector<std::string>& warnings);

}  // namespace coastmesh
