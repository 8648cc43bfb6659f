#pragma once

#include <functional>
#include <stdexcept>
#include <string_view>

namespace coastmesh {

// Where rounds save their results for one region, so that another run can resume. The creator decides how and where.
// All functions may throw.
struct RegionCheckpoint {
  using Put = std::function<void(std::string_view bytes)>;
  using Read = std::function<void(std::string_view bytes)>;
  // Saves everything that `write` writes, in order, replacing the state saved before. If the process ends during this,
  // the previous state is kept.
  std::function<void(const std::function<void(const Put& put)>& write)> keep;
  // Calls `read` with the state that an earlier run saved; does not call it if there is none.
  std::function<void(const Read& read)> restore;
};

// The saved state cannot be resumed; the message says why.
struct BadCheckpoint : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace coastmesh
