#pragma once

#include <string_view>

namespace coastmesh {

// What a page is put together from: the files of apps/plot/page, as they were when the program was built.
extern const std::string_view kPageFrame;   // page.html, with marks where the other parts go
extern const std::string_view kPageStyle;   // page.css
extern const std::string_view kPageScript;  // the .js files, in the order in which apps/CMakeLists.txt names them

}  // namespace coastmesh
