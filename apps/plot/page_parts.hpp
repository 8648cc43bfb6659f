#pragma once

#include <string_view>

namespace coastmesh {

// The parts of a page: the files of apps/plot/page at the time when the program was built.
extern const std::string_view kPageFrame;   // page.html, with marks where the other parts go
extern const std::string_view kPageStyle;   // page.css
extern const std::string_view kPageScript;  // the .js files, in the order in which apps/CMakeLists.txt names them

}  // namespace coastmesh
