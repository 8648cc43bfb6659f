#pragma once

#include <array>
#include <string>
#include <vector>

namespace coastmesh {

// Models that a grid can be made for.
enum class Target { Adcirc, Schism, Fvcom, Telemac, Mike, Dflowfm, Swan, Fesom, Mpas };
inline constexpr std::array kTargetNames{"adcirc",  "schism", "fvcom", "telemac", "mike",
                                         "dflowfm", "swan",   "fesom", "mpas"};

// "adcirc|schism|…"
std::string allTargetNames();

// Returns whether the model uses latitudes as those of a sphere.
bool isOnSphere(Target target);

// Returns whether the model computes on quadrilaterals too.
bool acceptsQuads(Target target);

// The models with these names, each once, in the order of Target. Throws OptionError for an unknown name.
std::vector<Target> targetsNamed(const std::vector<std::string>& names);

}  // namespace coastmesh
