#pragma once

#include <functional>
#include <string_view>

#include "cluster/post.hpp"
#include "parallel/deal.hpp"

namespace coastmesh {

// How a rank other than 0 works; all functions may be called from several threads.
struct ServeOptions {
  std::function<bool()> stopped{};                  // polled: true if this process must end early
  std::function<bool()> memory_lacked{};            // called after a piece: true if it fails for lack of memory
  std::function<double()> peak_mib{};               // the peak memory of this process
  std::function<Reply(std::string_view)> answer{};  // answers requests without a region
};

// The loop of ranks other than 0: answers rank 0's requests until told to end. Returns false if stopped.
bool serveRankZero(Post& post, const ServeOptions& options);

}  // namespace coastmesh
