#pragma once

#include <functional>

#include "cluster/post.hpp"

namespace coastmesh {

// What ranks other than 0 do: they answer rank 0's requests until it sends them away. False where `stopped` said, from
// time to time, that this process is to end before.
bool serveRankZero(Post& post, const std::function<bool()>& stopped);

}  // namespace coastmesh
