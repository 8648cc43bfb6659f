#include "apps/usage/target_usage.hpp"

#include "gis/model/target.hpp"

namespace coastmesh {

void declareTargets(OptionTable& table, std::vector<std::string>& names, const std::string& help) {
  table.section(Section::Boundaries);
  table.texts({"--target", "Target models"}, names, allTargetNames(), false, help);
}

}  // namespace coastmesh
