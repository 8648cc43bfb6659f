#pragma once

#include <string>
#include <vector>

#include "gis/coast/coastline.hpp"

namespace coastmesh {

// `name` as a part of a file name that is valid on every system: characters with a meaning in paths or shells, and
// invisible ones, become '_'; blanks and dots at its ends are removed, and it is cut after 100 bytes. Letters of all
// languages are kept. Empty if nothing is left.
std::string safeFileName(const std::string& name);

// The names of `features` in file names: the attribute `field`, converted by `safeFileName`; or the
// feature's number if `field` is empty or has no value, preceded by its file's name if there are several
// files. Throws InputError if two have the same name, or differ only in case; OptionError if no feature has
// that attribute.
std::vector<std::string> namesOfFeatures(const std::vector<const Feature*>& features, const std::string& field);

}  // namespace coastmesh
