#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/pslg.hpp"
#include "gis/coast/coastline.hpp"
#include "gis/crs/resolution.hpp"
#include "gis/projection/projection.hpp"

namespace coastmesh {

// A line that the user named, with the domain on both sides: where features with lines run along one another, weirs
// come before constraints and these before borders of regions, of the same use the first feature.
struct DomainLine {
  std::size_t feature = 0;                  // index in `Coastline::features`
  FeatureUse use = FeatureUse::Constraint;  // Constraint, Weir or Region
  std::string name;                         // empty: none was given
  bool borders_region = false;              // a region has its border there, whatever else the line is
};

// A group of features as a valid PSLG in the working plane.
struct Domain {
  Pslg pslg;  // labelled: a segment's sides hold the index of a feature in `Coastline::features`, or kOutside
  std::vector<Point> input_points;  // one a point of the PSLG: where it lies in the input's CRS, the input's own bits
  Projection projection = Projection::plane();
  std::vector<DomainLine> lines{};  // what tags of segments refer to: see segment_tags.hpp
  Resolution resolution;            // what changes the domain further has to keep
  // Of a whole globe, where no side of a segment lies outside: what no feature holds, and what holds the place beyond
  // all of the plane.
  RegionId rest = kOutside, beyond = kOutside;

  bool closed() const { return rest != kOutside; }
};

}  // namespace coastmesh
