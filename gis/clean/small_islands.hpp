#pragma once

#include <functional>
#include <vector>

#include "gis/clean/geodesic_area.hpp"
#include "gis/coast/coastline.hpp"

namespace coastmesh {

// Takes islands smaller than `least_m2` square metres out of features: holes of areas, and polygons of land and coasts.
// Islands that a frame cut stay, since their full area is unknown.
class SmallIslands {
 public:
  SmallIslands(const Crs& crs, double least_m2) : area_(crs), least_m2_(least_m2), geographic_(crs.geographic) {}

  // Returns the feature's polygons without them. Rings inside a hole that is taken out, such as ponds, are taken out
  // too. Calls `drop(place)` for each island.
  std::vector<Polygon> without(const Feature& feature, const std::function<void(const Point&)>& drop) const;

 private:
  bool isSmall(const Ring& ring) const { return !ring.empty() && area_.of(ring) < least_m2_; }
  std::vector<Polygon> withoutLand(const Feature& feature, const std::function<void(const Point&)>& drop) const;
  std::vector<Polygon> withoutHoles(const Feature& feature, const std::function<void(const Point&)>& drop) const;

  RingArea area_;
  double least_m2_;
  bool geographic_;
};

}  // namespace coastmesh
