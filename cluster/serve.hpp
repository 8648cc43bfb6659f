#pragma once

#include <functional>

#include "cluster/post.hpp"

namespace coastmesh {

// What ranks other than 0 do: they answer rank 0's requests until it sends them away. False where `stopped` said, from
// time to time, that this process is to end before. Where `memory_lacked` says, after a piece, that memory was refused,
// the piece is answered as one that takes more than there is.
bool serveRankZero(Post& post, const std::function<bool()>& stopped, const std::function<bool()>& memory_lacked);

}  // namespace coastmesh
