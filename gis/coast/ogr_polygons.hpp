#pragma once

#include <ogr_geometry.h>

#include <memory>
#include <vector>

#include "gis/coast/coastline.hpp"

namespace coastmesh {

using Shape = std::unique_ptr<OGRGeometry>;

// The polygons as they are, valid or not. REQUIRES: each has an outer ring.
Shape shapeOf(const std::vector<Polygon>& polygons);

// The polygons in `shape` and its parts, in their order; lines and points are left out.
std::vector<const OGRPolygon*> polygonsOf(const OGRGeometry& shape);

Polygon fromOgr(const OGRPolygon& polygon);

}  // namespace coastmesh
