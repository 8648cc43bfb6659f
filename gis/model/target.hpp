#pragma once

#include <array>
#include <string>
#include <vector>

namespace coastmesh {

// Models that a grid may be for.
enum class Target { Adcirc, Schism, Fvcom, Telemac, Dflowfm, Swan, Fesom, Mpas };
inline constexpr std::array kTargetNames{"adcirc", "schism", "fvcom", "telemac", "dflowfm", "swan", "fesom", "mpas"};

// "adcirc|schism|…"
std::string allTargetNames();

// Whether the model takes latitudes for those of a sphere.
bool isOnSphere(Target target);

// The models so named, each once, in the order of Target. Throws OptionError for a name that is none.
std::vector<Target> targetsNamed(const std::vector<std::string>& names);

}  // namespace coastmesh
