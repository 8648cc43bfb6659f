#pragma once

#include <string>

#include "gis/grid.hpp"

namespace coastmesh {

// SMS .2dm of triangles, with the CRS of a .prj beside it. Materials become features where there are several. Node
// strings that follow the rim become boundaries: numbered by us they keep their role, others are open, or land or an
// island where they close. Throws InputError with file and line.
Grid read2dm(const std::string& path);

}  // namespace coastmesh
