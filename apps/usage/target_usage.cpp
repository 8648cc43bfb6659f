#include "apps/usage/target_usage.hpp"

#include "gis/model/target.hpp"

namespace coastmesh {

void declareTargets(CommandLine& line, std::vector<std::string>& names, const std::string& help) {
  line.texts("--target", names, allTargetNames(), false, help);
}

}  // namespace coastmesh
