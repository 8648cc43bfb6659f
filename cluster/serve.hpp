#pragma once

#include <functional>
#include <string_view>

#include "cluster/post.hpp"
#include "parallel/deal.hpp"

namespace coastmesh {

// How a rank other than 0 serves; all may be called from several threads.
struct ServeOptions {
  std::function<bool()> stopped;                  // from time to time: whether this process is to end before
  std::function<bool()> memory_lacked;            // after a piece: then it is answered as one that takes too much
  std::function<double()> peak_mib;               // the most memory that this process has held
  std::function<Reply(std::string_view)> answer;  // to what is asked that is of no region
};

// What ranks other than 0 do: they answer rank 0's requests until it sends them away. False where they were stopped.
bool serveRankZero(Post& post, const ServeOptions& options);

}  // namespace coastmesh
