#pragma once

#include <ogr_geometry.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gis/coast/coastline.hpp"

namespace coastmesh {

// What one geometry holds, taken out of OGR: Z and M dropped, curves made of straight pieces. A ring comes without its
// repeated last point.
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

// Drops the last point of a ring that repeats the first, counts the ring, and reports one that does not close.
// REQUIRES: not empty.
void closeRing(Ring& ring, GeometryParts& parts);

// Adds what `geometry` holds to `parts`. Throws InputError for a coordinate that is not finite; `what` names the
// feature in its sentence.
void takeApart(const OGRGeometry& geometry, const std::string& what, GeometryParts& parts);

}  // namespace coastmesh
