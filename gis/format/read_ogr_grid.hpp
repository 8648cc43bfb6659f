#pragma once

#include <string>

#include "gis/grid/grid.hpp"

namespace coastmesh {

// Triangles from a file that OGR reads: the layer `triangles`, or the only layer of polygons. They have no direction in
// GIS, so all come out counter-clockwise, in the order of their `id` where they have one. Nodes are what corners share,
// bit for bit, in the order of the layer `nodes` where there is one, else of their first corner. Fields and layers as
// `layersOf` names them give z, angles, areas, features and boundaries. Without a layer of nodes z is the corners'
// third coordinate, where they agree. Throws InputError with the feature.
Grid readOgrGrid(const std::string& path, const Crs& unsaid);

}  // namespace coastmesh
