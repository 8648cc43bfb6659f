#pragma once

#include <string_view>

namespace coastmesh {

// In the name of a staging folder, before what makes it unique.
inline constexpr std::string_view kStagingMark = ".part-";
// Of the files in it that were replaced, after their names.
inline constexpr std::string_view kBackupEnding = "~";

}  // namespace coastmesh
