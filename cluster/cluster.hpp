#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <vector>

#include "cluster/post.hpp"
#include "parallel/deal.hpp"

namespace coastmesh {

// Rank 0's side of a run on several ranks: the others process pieces.
class Cluster {
 public:
  // `stopped` returns true if the run is being aborted: then the others are not waited for.
  Cluster(Post& post, std::function<bool()> stopped);
  // Stops the others.
  ~Cluster();
  Cluster(const Cluster&) = delete;
  Cluster& operator=(const Cluster&) = delete;

  // Starts the others, each with `threads` threads; 0: as many as it has cores.
  void start(int threads);
  const Helpers& helpers() const { return helpers_; }

 private:
  void take(Message&& message, int from);

  Post& post_;
  std::function<bool()> stopped_;
  Helpers helpers_;
  std::mutex mutex_;
  std::condition_variable changed_;
  int gone_ = 0;            // ranks that have left
  std::vector<int> rooms_;  // for each rank: requests that it has room for
  struct Awaited {
    std::function<void(Reply&&)> take;
    bool has_room = false;  // the request occupies room, which the reply frees
  };
  std::map<std::uint64_t, Awaited> awaited_;
  std::uint64_t requests_ = 0, pieces_ = 0;
  std::vector<double> peak_mib_;  // one for each rank
  std::uint32_t regions_ = 0;
};

}  // namespace coastmesh
