#pragma once

#include <string>
#include <string_view>

#include "gis/grid/grid.hpp"

namespace coastmesh {

inline constexpr std::string_view kIbtypeMark = " ibtype ";  // before ADCIRC's type, at the end of a boundary's name

// Reads Gmsh .msh 4.1 or 2.0 to 2.2, ASCII, triangles of three nodes, in the order of their tags; CRS from a .prj. Line
// elements that follow the mesh's boundary become boundaries, one or more for each physical group: a name that starts
// with land, island, open or river gives the role; otherwise closed ones are land or islands by their direction and
// open ones land. Those inside become lines: a name that starts with a kind of line ("weir North") gives the kind, any
// other means a constraint. Physical surfaces become features if there are several or one has a name other than
// "domain". z: node data "z", else the third coordinate if it is not 0 throughout. Throws InputError with file and
// line.
Grid readGmsh(const std::string& path, const Crs& unsaid);

}  // namespace coastmesh
