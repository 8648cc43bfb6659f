#include "apps/target_usage.hpp"

#include <algorithm>

namespace coastmesh {

namespace {

std::string allNames() {
  std::string all;
  for (const char* name : kTargetNames) all += (all.empty() ? "" : "|") + std::string(name);
  return all;
}

}  // namespace

void declareTargets(CommandLine& line, std::vector<std::string>& names, const std::string& help) {
  line.texts("--target", names, allNames(), false, help);
}

std::vector<Target> targetsNamed(const std::vector<std::string>& names) {
  std::vector<Target> targets;
  for (const std::string& name : names) {
    const auto found = std::ranges::find(kTargetNames, name, [](const char* known) { return std::string(known); });
    if (found == kTargetNames.end()) throw UsageError("--target: '" + name + "' is none of " + allNames());
    targets.push_back(static_cast<Target>(found - kTargetNames.begin()));
  }
  std::ranges::sort(targets);
  const auto repeated = std::ranges::unique(targets);
  targets.erase(repeated.begin(), repeated.end());
  return targets;
}

}  // namespace coastmesh
