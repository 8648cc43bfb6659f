#pragma once

#include <vector>

#include "core/ids.hpp"
#include "core/point.hpp"

namespace coastmesh {

// A vertex that the user requested.
struct AskedPoint {
  VertexId source = kNone;  // its number in the domain
  Point at;
};

// The vertices of a domain that the user requested, while its shores change.
class AskedPoints {
 public:
  // `asked`: numbers of points; any may be repeated.
  AskedPoints(const std::vector<VertexId>& asked, const std::vector<Point>& points);

  // Their numbers in the domain, ascending.
  const std::vector<VertexId>& sources() const { return sources_; }

  // Those that are not among these sources.
  std::vector<AskedPoint> missingFrom(const std::vector<VertexId>& sources) const;

 private:
  std::vector<VertexId> sources_;
  std::vector<Point> at_;
};

}  // namespace coastmesh
