#pragma once

#include <ogr_geometry.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gis/coast/coastline.hpp"

namespace coastmesh {

// The parts of one OGR geometry: Z and M are dropped, curves divided into straight pieces. Rings do not repeat their
// first point.
struct GeometryParts {
  std::vector<Polygon> polygons;
  std::vector<std::vector<Point>> lines;  // as given: a closed one repeats its first point
  std::vector<Point> points;
  std::uint64_t coordinates = 0;
  std::uint64_t rings = 0;
  std::uint64_t unclosed_rings = 0;
  std::optional<Point> unclosed_place;  // of the first unclosed ring

  bool empty() const { return polygons.empty() && lines.empty() && points.empty(); }
};

// Counts a ring and drops its last point if that repeats the first; otherwise counts it as unclosed too. REQUIRES: not
// empty.
void closeRing(Ring& ring, GeometryParts& parts);

// Adds the parts of `geometry` to `parts`. Throws InputError, with `what` as the feature's name: a coordinate that is
// not finite or out of range, a geometry other than points, lines and polygons, a curve that cannot be linearised.
void takeApart(const OGRGeometry& geometry, const std::string& what, GeometryParts& parts);

}  // namespace coastmesh
