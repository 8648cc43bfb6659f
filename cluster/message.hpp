#pragma once

#include <cstdint>
#include <memory>
#include <string>

namespace coastmesh {

// What ranks tell one another. Rank 0 asks, the others answer.
struct Message {
  enum class Kind : std::uint64_t {
    Start,    // to all: begin to work, with `number` threads, or as many as there are cores where that is 0
    Ready,    // from a rank: it works with `number` threads, `region` as of Reply
    Begin,    // to all: `bytes` are what pieces of `region` share
    Request,  // one piece of `region`, under a `number` of its own
    Ask,      // something that is of no region, under a `number` of its own
    Reply,    // to the request of that number; `outcome` says what `bytes` are, `region` the rank's memory, KiB
    End,      // to all: no more of `region`
    Stop,     // to all: there is no more to be done
    Gone,     // from a rank, to that: it sends nothing more
  };
  Kind kind = Kind::Stop;
  std::uint64_t region = 0, number = 0, outcome = 0;
  std::shared_ptr<const std::string> bytes;  // shared where the same goes to several; null: none
};

}  // namespace coastmesh
