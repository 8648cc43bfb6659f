#pragma once

#include <string>

#include "gis/grid/grid.hpp"

namespace coastmesh {

// Reads triangles from a file that OGR reads: the layer `triangles`, or the only layer of polygons, in the order of
// `id` if it has this field. Columns node1 to node3 give the winding; without them neighbours are oriented alike, and
// most triangles counter-clockwise on the ground, since polygons in GIS have no winding. Corners at the same place, bit
// for bit, are one node unless these columns name several there; nodes are in the order of the layer `nodes` if there
// is one, else of their first corner. Columns and layers named as by `layersOf` give z, sizes, angles, areas, features,
// boundaries and lines. Without a layer of nodes z is the third coordinate of the corners, if they agree. Throws
// InputError with the feature.
Grid readOgrGrid(const std::string& path, const Crs& unsaid);

}  // namespace coastmesh
