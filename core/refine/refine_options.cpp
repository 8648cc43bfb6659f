#include "core/refine/refine_options.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>

namespace coastmesh {

void RefineStats::add(const RefineStats& other) {
  steiner_points += other.steiner_points;
  for (std::size_t i = 0; i < by_type.size(); ++i) by_type[i] += other.by_type[i];
  segment_splits += other.segment_splits;
  relocations += other.relocations;
  removals += other.removals;
  unmended += other.unmended;
  merges += other.merges;
  budget_reached |= other.budget_reached;
  unresolved.insert(unresolved.end(), other.unresolved.begin(), other.unresolved.end());
}

void requireInRange(const RefineOptions& options) {
  const auto require = [](bool holds, const char* name, double value, const char* range) {
    if (holds) return;
    std::ostringstream text;
    text << "RefineOptions::" << name << " is " << value << ", not " << range;
    throw std::invalid_argument(text.str());
  };
  // Comparisons with NaN are false.
  require(options.min_angle_deg >= 0.0 && options.min_angle_deg <= 45.0, "min_angle_deg", options.min_angle_deg,
          "0 to 45 degrees");
  require(options.max_angle_deg >= 60.0 && options.max_angle_deg <= 180.0, "max_angle_deg", options.max_angle_deg,
          "60 to 180 degrees");
  require(options.resolution >= 0.0 && std::isfinite(options.resolution), "resolution", options.resolution,
          "a finite number of 0 or more");
  require(options.surface.curvature >= 0.0 && std::isfinite(options.surface.curvature), "surface.curvature",
          options.surface.curvature, "a finite number of 0 or more");
  require(options.least_edge >= 0.0 && std::isfinite(options.least_edge), "least_edge", options.least_edge,
          "a finite number of 0 or more");
  require(options.size_max > 0.0, "size_max", options.size_max, "above 0");
  require(options.size_scale > 0.0 && std::isfinite(options.size_scale), "size_scale", options.size_scale,
          "a finite number above 0");
}

TriangleBound boundOf(const RefineOptions& options) {
  TriangleBound bound(options.min_angle_deg, options.max_angle_deg, options.size_max, options.size,
                      kLongestShare * options.size_scale);
  bound.surface = options.surface;
  return bound;
}

TriangleBound strictBoundOf(const RefineOptions& options) {
  TriangleBound bound(options.min_angle_deg, options.max_angle_deg, options.size_max);
  bound.surface = options.surface;
  return bound;
}

}  // namespace coastmesh
