#pragma once

#include <string>
#include <vector>

#include "gis/coast/coastline.hpp"

namespace coastmesh {

// `name` as a part of a file's name that every system takes: characters that mean something in paths or shells, and
// those that cannot be seen, become '_'; blanks and dots at its ends go, and so does what is longer than 100 bytes.
// Letters of all languages stay. Empty where nothing is left.
std::string safeFileName(const std::string& name);

// What each of `features` is called in the names of files: by its attribute `field` as `safeFileName` makes it; by its
// number where `field` is empty or says nothing of it, with its file's name before it where they are of several files.
// Throws InputError where two have one name, or differ by upper and lower case alone; OptionError where no feature has
// that attribute.
std::vector<std::string> namesOfFeatures(const std::vector<const Feature*>& features, const std::string& field);

}  // namespace coastmesh
