#pragma once

#include <functional>
#include <stdexcept>
#include <string_view>

namespace coastmesh {

// Where rounds save their results for one region, so that another run can resume. Whoever creates this decides how and
// where. All functions may throw.
struct RegionCheckpoint {
  using Put = std::function<void(std::string_view bytes)>;
  using Read = std::function<void(std::string_view bytes)>;
  // Saves everything that `write` writes, in order, in place of what was saved before. If the process ends during this,
  // what was saved before is kept.
  std::function<void(const std::function<void(const Put& put)>& write)> keep;
  // Calls `read` with what an earlier run saved; not at all if there is nothing.
  std::function<void(const Read& read)> restore;
};

// What was saved cannot be resumed; the message says why.
struct BadCheckpoint : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace coastmesh
