#pragma once

#include <string>

#include "gis/grid/grid.hpp"

namespace coastmesh {

// Node data of a mesh on a globe, whose points are places in space.
inline constexpr const char *kVtuLongitude = "longitude", *kVtuLatitude = "latitude";

// VTK's unstructured grid of triangles as XML: arrays appended (raw or base64) or inline (ASCII or base64), not
// compressed. Lines and points among the cells are left out; node data `z`, and what `writeVtu` adds, are read. Throws
// InputError.
Grid readVtu(const std::string& path, const Crs& unsaid);

}  // namespace coastmesh
