#pragma once

namespace coastmesh {

// Removes a folder with the files and the few levels of folders in it, and asks for no memory, as there may be none.
// True where it is not there any more.
bool removeFolder(const char* path) noexcept;

}  // namespace coastmesh
