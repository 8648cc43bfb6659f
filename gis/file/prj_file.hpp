#pragma once

#include <string>
#include <string_view>

#include "gis/crs/crs.hpp"

namespace coastmesh {

// The CRS as ESRI's WKT, in one line. REQUIRES: not a plane. Throws OutputError, with the file that is written and the
// `place` in it ("for a .prj file"), if there is no such form.
std::string esriWkt(const Crs& crs, const std::string& file, std::string_view place);

// The .prj file with the CRS of `path`, for formats that cannot hold it.
std::string prjBeside(const std::string& path);

// Throws OutputError if .prj files cannot hold the CRS of the mesh file `path`.
void requirePrjForm(const std::string& path, const Crs& crs);

// True if the CRS says by itself how far its datum is from WGS 84 (+towgs84, +nadgrids): .prj files leave that out.
bool prjLosesDatumShift(const Crs& crs);

// Writes the CRS of the mesh file `path` beside it as ESRI's WKT; nothing for a plane. Throws OutputError.
void writePrjBeside(const std::string& path, const Crs& crs);

// The CRS in a .prj beside `path`; `unsaid` if there is none. Throws InputError.
Crs readPrjBeside(const std::string& path, const Crs& unsaid = {});

}  // namespace coastmesh
