#pragma once

#include <string>
#include <string_view>

#include "gis/grid/grid.hpp"

namespace coastmesh {

inline constexpr std::string_view kIbtypeMark = " ibtype ";  // with ADCIRC's type, at the end of a boundary's name

// Gmsh .msh 4.1 or 2.0 to 2.2, ASCII, triangles of three nodes, in the order of their tags; CRS from a .prj. Line
// elements that follow the mesh's boundary become boundaries, one or more a physical group: a group whose name starts
// with land, island, open or river says the role; else closed ones are land or islands by their direction and open ones
// land. Those inside become lines: "weir North" is a weir, other names are those of constraints. Physical surfaces
// become features where there are several or they are named. z: node data of that name, else the third coordinate where
// it is not 0 throughout. Throws InputError with file and line.
Grid readGmsh(const std::string& path, const Crs& unsaid);

}  // namespace coastmesh
