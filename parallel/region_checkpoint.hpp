#pragma once

#include <functional>
#include <stdexcept>
#include <string_view>

namespace coastmesh {

// Where rounds keep what they have come to with one region, so that another run goes on from there. How, and where, is
// known to whoever made this. All functions may throw.
struct RegionCheckpoint {
  using Put = std::function<void(std::string_view bytes)>;
  using Read = std::function<void(std::string_view bytes)>;
  // Keeps all that `write` puts, one after another, in place of what was kept before: all of it or, where the process
  // ends on the way, what was kept before.
  std::function<void(const std::function<void(const Put& put)>& write)> keep;
  // Calls `read` with what an earlier run kept; not at all where there is nothing.
  std::function<void(const Read& read)> restore;
};

// What was kept cannot be gone on from: why.
struct BadCheckpoint : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace coastmesh
