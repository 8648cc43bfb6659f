#pragma once

#include <optional>
#include <string>

class OGRFeature;

namespace coastmesh {

// The value of an attribute, by its index; nullopt if it is null, or the index is below 0. `what`: the feature, for
// messages. Throws InputError if it is not a number of at least `least`.
std::optional<double> numberAttribute(const OGRFeature& feature, int field, double least, const std::string& what);

}  // namespace coastmesh
