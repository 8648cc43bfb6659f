#pragma once

#include <string>

namespace coastmesh {

// Why a file in the folder of `path` cannot grow at present, in the system's words: no space left, a quota, a limit of
// the size of files that one there has reached. Empty if it can, or if that is unknown. Libraries often do not say that
// this is why writing failed. `error`: errno after that, which may say so: files that have no name any more can only be
// seen by it. Writes 64 KiB into a nameless file there.
std::string whyNoRoom(const std::string& path, int error = 0);

}  // namespace coastmesh
