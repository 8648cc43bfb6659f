#pragma once

#include <string>

#include "gis/grid.hpp"

namespace coastmesh {

// Gmsh .msh 4.1 or 2.2, ASCII, with the CRS in a .prj. Each boundary is a curve with a physical group ("land 1",
// "island 2", "open 3") of line elements, each feature a surface with its own ("feature 17"; "domain" where there is
// none). Tags of nodes and triangles follow the grid's order. The mesh lies in the plane: z is node data, since solvers
// take a third coordinate for a curved surface. Throws OutputError.
void writeGmsh(const Grid& grid, const std::string& path);
void writeGmsh22(const Grid& grid, const std::string& path);

}  // namespace coastmesh
