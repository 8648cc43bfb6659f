#include "gis/model/target.hpp"

#include <algorithm>

#include "gis/error.hpp"

namespace coastmesh {

std::string allTargetNames() {
  std::string all;
  for (const char* name : kTargetNames) all += (all.empty() ? "" : "|") + std::string(name);
  return all;
}

bool isOnSphere(Target target) { return target == Target::Fesom || target == Target::Mpas; }

bool acceptsQuads(Target target) {
  return target == Target::Schism || target == Target::Mike || target == Target::Dflowfm;
}

std::vector<Target> targetsNamed(const std::vector<std::string>& names) {
  std::vector<Target> targets;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(kTargetNames, name, [](const char* known) { return std::string(known); });
    if (found == kTargetNames.end()) throw OptionError("--target: '" + name + "' is none of " + allTargetNames());
    targets.push_back(static_cast<Target>(found - kTargetNames.begin()));
  }
  std::ranges::sort(targets);
  const auto repeated = std::ranges::unique(targets);
  targets.erase(repeated.begin(), repeated.end());
  return targets;
}

}  // namespace coastmesh
