#pragma once

#include <string>

#include "gis/grid.hpp"

namespace coastmesh {

// UGRID-1.0 NetCDF (64-bit offset; CDF-5 past its 4 GiB an array) as MDAL, xugrid and D-FlowFM read it: mesh topology
// `mesh2d` with face_nodes, edge_nodes and the boundary's edges, the CRS in `projected_coordinate_system` or `wgs84`,
// elevation, smallest angle, area and source fid as data. A node without z holds the fill value -999. Throws
// OutputError.
void writeUgrid(const Grid& grid, const std::string& path);

}  // namespace coastmesh
