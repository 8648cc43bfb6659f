#pragma once

#include <string>
#include <utility>
#include <vector>

#include "gis/crs/crs.hpp"

namespace coastmesh {

// The attributes of a CRS in the CF conventions besides its WKT (CF 1.8, Appendix F).
struct CfGridMapping {
  std::string name;  // grid_mapping_name; "Unknown projected", as D-FlowFM writes it, if CF has no name
  std::vector<std::pair<std::string, double>> parameters;
};

// REQUIRES: not a plane.
CfGridMapping cfGridMapping(const Crs& crs);

}  // namespace coastmesh
