#pragma once

#include <string>

#include "gis/crs/crs.hpp"

namespace coastmesh {

// The .prj file that says the CRS of `path` for formats that have no room for it inside.
std::string prjBeside(const std::string& path);

// Writes the CRS of the mesh file `path` beside it as ESRI's WKT; nothing for a plane. Throws OutputError.
void writePrjBeside(const std::string& path, const Crs& crs);

// The CRS that a .prj beside `path` says; `unsaid` where there is none. Throws InputError.
Crs readPrjBeside(const std::string& path, const Crs& unsaid = {});

}  // namespace coastmesh
