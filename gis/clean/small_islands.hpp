#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "gis/clean/areas_within.hpp"
#include "gis/clean/geodesic_area.hpp"
#include "gis/coast/coastline.hpp"

namespace coastmesh {

// Takes islands smaller than `least_m2` square metres out of features: holes of areas, unless another area lies in
// them, and polygons of land and coasts. Polygons of land that share edges, such as countries or the pieces of an
// island that a data set cuts at tiles or at the antimeridian, are one island. Islands that a frame cut stay, since
// their full area is unknown. A ring of coasts round the place that is in the water, or without one, with the water to
// its right within it, is the shore of a sea: its holes are islands.
class SmallIslands {
 public:
  // Measures the land among the group's features. REQUIRES: `coastline` and `areas`, those of all of it, outlive it.
  SmallIslands(const Coastline& coastline, const std::vector<std::size_t>& members, double least_m2,
               const AreasWithin& areas);

  // Returns the polygons of a feature of the group without them. Rings inside a hole that is taken out, such as ponds,
  // are taken out too. Calls `drop(place)` for each polygon or hole.
  std::vector<Polygon> without(std::size_t member, const std::function<void(const Point&)>& drop) const;

 private:
  bool isSmall(const Ring& ring) const { return !ring.empty() && area_.of(ring) < least_m2_; }
  // True for a polygon of coasts that holds the place that the user said is in the water.
  bool holdsWaterPlace(const Polygon& polygon, std::size_t member) const;
  // True for a polygon of coasts whose holes are islands.
  bool isSea(const Polygon& polygon, std::size_t member) const;
  Polygon withoutSmallHoles(const Polygon& polygon, std::size_t member,
                            const std::function<void(const Ring&)>& drop) const;
  std::vector<Polygon> withoutLand(std::size_t member, const std::function<void(const Point&)>& drop) const;
  std::vector<Polygon> withoutHoles(std::size_t member, const std::function<void(const Point&)>& drop) const;

  const Coastline* coastline_;
  const AreasWithin* areas_;
  RingArea area_;
  double least_m2_;
  std::vector<std::pair<std::size_t, std::size_t>> small_land_;  // features and their polygons, ascending
};

}  // namespace coastmesh
