#pragma once

#include <gdal_priv.h>

#include <memory>
#include <string>

namespace coastmesh {

// Lines as the tools of coastal models write them, which GDAL does not read: .ldb, .pli, .pliz and .pol of Delft3D and
// D-Flow FM (Deltares, D-Flow FM User Manual, polyline files), .i2s and .i3s of Blue Kenue (National Research Council
// Canada), .bln of Surfer (Golden Software).

// By the name's ending.
bool isLineFile(const std::string& path);

// One layer, named as the file without its ending. Its lines have the attribute `name` (.ldb, .pli, .pliz, .pol, .bln)
// or `value` (.i2s, .i3s), and a Z if the file has a third coordinate; a line of one point is a point. The rings of a
// .pol are closed. Missing values between points of a .ldb and its kin (999.999, -999) part a line. The CRS is that of
// a .prj beside the file; else there is none, unless a Blue Kenue file is in longitudes and latitudes: WGS 84.
// Throws InputError with the line of the file. REQUIRES: `isLineFile(path)`.
std::unique_ptr<GDALDataset> readLineFile(const std::string& path);

}  // namespace coastmesh
