#include "gis/weirs/weir_report.hpp"

#include "gis/for_count.hpp"
#include "gis/places.hpp"

namespace coastmesh {

std::vector<std::string> WeirReport::notes() const {
  if (boundaries == 0) return {};
  std::string text = std::to_string(boundaries) + forCount(boundaries, " weir", " weirs") + " for ADCIRC with " +
                     std::to_string(pairs) + forCount(pairs, " pair", " pairs") + " of nodes, " +
                     amount("%.3g", gaps.least);
  if (gaps.most > gaps.least) text += amount(" to %.3g", gaps.most);
  text += " m apart";
  if (walls > 0)
    text += "; water does not pass the " + std::to_string(walls) + forCount(walls, " edge", " edges") +
            " at their ends and where they meet";
  return {text};
}

}  // namespace coastmesh
