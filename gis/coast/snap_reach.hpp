#pragma once

#include <optional>

#include "core/point.hpp"
#include "gis/coast/snap_distance.hpp"
#include "gis/crs/crs.hpp"
#include "gis/crs/geographic_map.hpp"
#include "gis/geometry/box.hpp"

namespace coastmesh {

// Finds edges that cleaning may merge, by their places in the input's CRS. The reach is somewhat larger than the snap
// distance, since the working plane is not known yet: points that cleaning merges may be a few percent further apart.
// Usable from several threads at once.
class SnapReach {
 public:
  // For coordinates in `extent`. Throws InputError if PROJ has no transformation to longitudes and latitudes.
  SnapReach(const SnapDistance& snap, const Crs& crs, const Box& extent);

  bool isNothing() const { return length_ <= 0.0; }
  // A box that contains everything within reach of `box`.
  Box around(const Box& box) const;
  // True iff an end of one of the segments ab and cd is within reach of the other segment.
  bool holds(const Point& a, const Point& b, const Point& c, const Point& d) const;

 private:
  bool isNear(const Point& p, const Point& a, const Point& b) const;

  double length_ = 0.0;      // metres on the ground, with a margin; units of a plane
  double units_ = 0.0;       // the snap distance in the CRS at a scale of 1, or in degrees at the equator
  double most_units_ = 0.0;  // `length_` where the CRS has its largest scale
  double semi_major_m_ = 0.0, flattening_ = 0.0;
  bool geographic_ = false;
  std::optional<GeographicMap> map_;  // nullopt for a plane
};

}  // namespace coastmesh
