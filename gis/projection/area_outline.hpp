#pragma once

#include <string>
#include <vector>

#include "gis/coast/coastline.hpp"
#include "gis/projection/projection.hpp"

namespace coastmesh {

// An area for `Projection::fitted`, given the rings around it in coordinates of `crs`, which have it on their left.
// What a ring has on its right is land, which is left out, if the ring encloses that: an area without an outer ring,
// such as an ocean, is what is around its lands. `within` are places all over it, without which an area round a cap of
// the globe could not be told from the cap. `source` names it in errors. REQUIRES: at least one ring.
Coastline areaWithin(const Crs& crs, std::vector<Ring> rings, std::vector<Point> within, const std::string& source);

// The projection fitted to such an area.
Projection fittedWithin(const Crs& crs, std::vector<Ring> rings, std::vector<Point> within, const std::string& source,
                        SurfaceKind kind);

}  // namespace coastmesh
