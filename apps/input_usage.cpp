#include "apps/input_usage.hpp"

#include <limits>

namespace coastmesh {

void declareInputOptions(CommandLine& line, InputOptions& options) {
  constexpr NumberRange kNotNegative{0.0, std::numeric_limits<double>::infinity()};
  line.texts("--layer", options.filter.layers, "NAME", false, "read only this layer; repeat it for several");
  line.text("--where", options.filter.where, "SQL",
            "read only features for which this holds, such as \"kind = 'sea' AND area > 5\"");
  line.number("--snap", options.snap_m, "M", kNotNegative,
              "points nearer than this become one; in a plane only where it is given", &options.snap_in_plane);
  line.number("--simplify", options.simplify_m, "M", kNotNegative,
              "how far the simplified shore may lie from the input");
  line.number("--min-island-area", options.min_island_area_m2, "M2", kNotNegative, "fill islands smaller than this");
  line.text("--crs", options.crs, "CRS",
            "plane to work in: auto fits a conformal projection, plane takes coordinates as they are, or anything that "
            "PROJ knows");
}

}  // namespace coastmesh
