#pragma once

#include <functional>

#include "gis/clean/bend_edges.hpp"
#include "gis/coast/coastline.hpp"
#include "gis/coast/frame.hpp"

namespace coastmesh {

// As `frameCoastline`, and gives a length to edges of a whole turn of longitudes that run along the map (see
// turned_rings.hpp), as from (-180, 20) to (180, 20) round a band of latitudes. On the globe such an edge ends where it
// begins: in a plane that shows the globe, and as a geodesic, it has no length.
//
// Those of regions and of lines in the water get points along the straight line of longitudes and latitudes, since they
// have no other meaning, unless edges are geodesics; those of all features do if `line` is LonLat. Another polygon with
// a single one that does not reach a pole is taken to be cut off at the end of the map: it is closed over the pole, as
// a warning says. Throws InputError for other edges that are left within the frame. Frames are divided anyway, and
// cleaned files are left as they are. `hasLength`: whether an edge of a whole turn has a length in the working plane,
// as in that of Mercator; it is straight there then, like any other.
FrameReport frameWithWholeTurns(Coastline& coastline, const FrameOptions& options, EdgeLine line,
                                const std::function<bool(const Point&, const Point&)>& hasLength);

}  // namespace coastmesh
