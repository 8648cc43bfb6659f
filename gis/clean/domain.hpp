#pragma once

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "core/pslg.hpp"
#include "gis/coast/coastline.hpp"
#include "gis/crs/resolution.hpp"
#include "gis/projection/projection.hpp"

namespace coastmesh {

// A line given by the user, with the domain on both sides. Where several run along one edge, weirs take precedence over
// constraints, and these over borders of regions; within a use the first feature.
struct DomainLine {
  std::size_t feature = 0;                  // index in `Coastline::features`
  FeatureUse use = FeatureUse::Constraint;  // Constraint, Weir or Region
  std::string name;                         // empty: none
  bool borders_region = false;              // it is a region's border too, whatever its use
};

// A group of features as a valid PSLG in the working plane.
struct Domain {
  Pslg pslg;  // labelled: a segment's sides hold the index of a feature in `Coastline::features`, or kOutside
  std::vector<Point> input_points;  // for each point of the PSLG: its place in the input's CRS, with the input's bits
  Projection projection = Projection::plane();
  std::vector<VertexId> asked{};    // points of the PSLG that the user requested as vertices, on segments or not
  std::vector<DomainLine> lines{};  // the lines that tags of segments refer to: see segment_tags.hpp
  // The coast between the water and a flood plain, in the plane, if it is no line of the PSLG: sizes count it as shore.
  std::vector<std::pair<Point, Point>> coast{};
  std::vector<std::pair<Point, Point>> frame{};  // sides of the frame, in the plane, which moving shores may reach
  Resolution resolution;                         // to be kept by later changes of the domain
  // For a whole globe, where no side of a segment is outside: the label of places in no feature, and the label at the
  // plane's point at infinity.
  RegionId rest = kOutside, beyond = kOutside;

  bool closed() const { return rest != kOutside; }
};

}  // namespace coastmesh
