#pragma once

namespace coastmesh {

// Removes a folder with its files and a few levels of folders, without allocating memory. True if it no longer exists.
bool removeFolder(const char* path) noexcept;

// Reserves a descriptor, if possible, for `removeFolder` to use when the process has no other left.
void keepSpareDescriptor() noexcept;

}  // namespace coastmesh
